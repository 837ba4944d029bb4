//! Where do textures lie on a mesh, and do its tangents follow them?

use std::fs;

use glam::{Vec2, Vec3};
use image::{ImageFormat, Rgb, RgbImage};
use proptest::prelude::*;
use umber::scene::{self, LoadOptions, Mesh, Scene};

use crate::mutation;
use crate::textures::files::file;
use crate::tolerances::TANGENT;

/// The scene of `model.obj` beside an MTL file of material `m`, and a flat `n.png`.
fn load(obj: &str, mtl: &str) -> Result<Scene, scene::Error> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let write = |name: &str, bytes: &[u8]| fs::write(folder.path().join(name), bytes);
    let flat = file(
        RgbImage::from_pixel(2, 2, Rgb([128, 128, 255])),
        ImageFormat::Png,
    );
    write("n.png", &flat).expect("a written file");
    write("m.mtl", format!("newmtl m\n{mtl}").as_bytes()).expect("a written file");
    write("model.obj", obj.as_bytes()).expect("a written file");
    scene::load(&folder.path().join("model.obj"), &LoadOptions::default())
}

const MAPPED: &str = "map_Kd n.png\n";
const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

fn check_parallel(mesh: &Mesh) {
    let count = mesh.positions.len();
    assert_eq!(mesh.normals.len(), count);
    assert_eq!(mesh.coordinates.len(), count);
    assert!(mesh.tangents.is_empty() || mesh.tangents.len() == count);
    assert!(mesh.indices.iter().all(|&vertex| (vertex as usize) < count));
}

#[test]
fn coordinates_of_an_obj_are_kept_where_a_map_needs_them() {
    let body = format!("{SQUARE}vt 0 0\nvt 2 0\nvt 2 1 7\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3 4/4\n");
    let scene = load(&format!("mtllib m.mtl\n{body}"), MAPPED).expect("a good model");
    let mesh = &scene.meshes[0];
    check_parallel(mesh);
    for (position, &pair) in mesh.positions.iter().zip(&mesh.coordinates) {
        assert_eq!(pair, [2.0 * position[0], position[1]]);
    }
    assert!(mesh.tangents.is_empty(), "no normal map");
    let late = body.replace("usemtl", "mtllib m.mtl\nusemtl");
    let late = load(&late, MAPPED).expect("a good model");
    assert_eq!(late.meshes[0], *mesh, "named after the coordinates");
    let bare = load(&format!("mtllib m.mtl\n{body}"), "Kd 1 0 0\n").expect("a good model");
    assert!(bare.meshes[0].coordinates.is_empty(), "no map");
}

#[test]
fn a_seam_splits_a_vertex() {
    let faces = "usemtl m\nf 1/1 2/2 3/2\nf 1/2 3/2 4/1\n";
    let text = format!("mtllib m.mtl\n{SQUARE}vt 0 0\nvt 1 0\n{faces}");
    let scene = load(&text, MAPPED).expect("a good model");
    assert_eq!(scene.meshes[0].positions.len(), 5);
    check_parallel(&scene.meshes[0]);
}

#[test]
fn missing_coordinates_are_zero_with_a_warning_or_all_projected() {
    let text = format!("mtllib m.mtl\n{SQUARE}vt 0.5 0.5\nusemtl m\nf 1/1 2/1 3\nf 1/1 3 4\n");
    let scene = load(&text, MAPPED).expect("a good model");
    let wanted = "2 vertices of 'unnamed_object' have no texture coordinates";
    assert!(
        scene.warnings.iter().any(|w| w.contains(wanted)),
        "{:?}",
        scene.warnings
    );
    assert!(scene.meshes[0].coordinates.contains(&[0.0; 2]));
    let text = format!("mtllib m.mtl\n{SQUARE}vt 0.5 0.5\nusemtl m\nf 1 2 3 4\n");
    let scene = load(&text, MAPPED).expect("a good model");
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
    assert!(scene.meshes[0].coordinates.contains(&[1.0, 1.0]), "metres");
}

/// A scene of one shape with the given maps.
fn shape(name: &str, map: &str) -> Scene {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let flat = file(
        RgbImage::from_pixel(2, 2, Rgb([128, 128, 255])),
        ImageFormat::Png,
    );
    fs::write(folder.path().join("n.png"), flat).expect("a written file");
    let text = format!(
        "[material.m]\n{map} = \"n.png\"\n[model.x]\nshape = \"{name}\"\nmaterial = \"m\"\n"
    );
    let path = folder.path().join("scene.toml");
    fs::write(&path, text).expect("a written file");
    scene::load(&path, &LoadOptions::default()).expect("a good scene")
}

#[test]
fn a_box_is_textured_in_metres_and_never_mirrored() {
    for name in ["cube", "sphere", "kettle", "hand", "timber", "plane"] {
        let scene = shape(name, "base_color_map");
        for mesh in &scene.meshes {
            check_parallel(mesh);
            for triangle in mesh.indices.chunks_exact(3) {
                let at = |k: usize| Vec3::from_array(mesh.positions[triangle[k] as usize]);
                let uv = |k: usize| Vec2::from_array(mesh.coordinates[triangle[k] as usize]);
                let normal = (at(1) - at(0)).cross(at(2) - at(0));
                let turn = (uv(1) - uv(0)).perp_dot(uv(2) - uv(0));
                // The side's share of the area: at least 1 / sqrt(3), and never negative.
                let share = turn / normal.length();
                let tiny = normal.length() < 1e-9;
                assert!(tiny || (0.57..1.0001).contains(&share), "{name}: {share}");
            }
        }
    }
}

#[test]
fn text_on_a_box_stands_upright_on_all_six_sides() {
    let scene = shape("cube", "base_color_map");
    let mesh = &scene.meshes[0];
    let mut seen = Vec::new();
    for triangle in mesh.indices.chunks_exact(3) {
        let at = |k: usize| Vec3::from_array(mesh.positions[triangle[k] as usize]);
        let uv = |k: usize| Vec2::from_array(mesh.coordinates[triangle[k] as usize]);
        let normal = (at(1) - at(0)).cross(at(2) - at(0)).normalize();
        let (right, up) = match normal.round().to_array() {
            [0.0, 1.0, 0.0] => (Vec3::X, Vec3::NEG_Z),
            [0.0, -1.0, 0.0] => (Vec3::X, Vec3::Z),
            [1.0, 0.0, 0.0] => (Vec3::NEG_Z, Vec3::Y),
            [-1.0, 0.0, 0.0] => (Vec3::Z, Vec3::Y),
            [0.0, 0.0, 1.0] => (Vec3::X, Vec3::Y),
            _ => (Vec3::NEG_X, Vec3::Y),
        };
        if normal.abs().max_element() > 0.999 {
            for k in 0..3 {
                assert!((uv(k) - Vec2::new(right.dot(at(k)), up.dot(at(k)))).length() < 1e-6);
            }
            seen.push(normal.round().to_array().map(|x| x as i32));
        }
    }
    seen.sort_unstable();
    seen.dedup();
    assert_eq!(seen.len(), 6, "{seen:?}");
}

fn check_tangents(mesh: &Mesh) {
    check_parallel(mesh);
    assert_eq!(mesh.tangents.len(), mesh.positions.len());
    for (tangent, normal) in mesh.tangents.iter().zip(&mesh.normals) {
        let along = Vec3::from_slice(&tangent[..3]);
        let off = (along.length() - 1.0)
            .abs()
            .max(along.dot(Vec3::from_array(*normal)).abs());
        assert!(f64::from(off) < TANGENT, "{tangent:?} {normal:?}: {off}");
        assert!(tangent[3].abs() == 1.0, "{tangent:?}");
    }
}

const NORMALS: &str = "norm n.png\n";

#[test]
fn tangents_run_along_u_and_the_mirrored_half_has_the_other_hand() {
    let text = format!(
        "mtllib m.mtl\n{SQUARE}v -1 0 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl m\n\
         f 1/1 2/2 3/3 4/4\nf 1/1 4/4 6/3 5/2\n"
    );
    let scene = load(&text, NORMALS).expect("a good model");
    let mesh = &scene.meshes[0];
    check_tangents(mesh);
    assert_eq!(mesh.positions.len(), 8, "split along the mirror");
    for triangle in mesh.indices.chunks_exact(3) {
        let middle: f32 = triangle
            .iter()
            .map(|&v| mesh.positions[v as usize][0])
            .sum();
        for &vertex in triangle {
            let wanted = if middle > 0.0 {
                [1.0, 0.0, 0.0, 1.0]
            } else {
                [-1.0, 0.0, 0.0, -1.0]
            };
            let tangent = mesh.tangents[vertex as usize];
            let off = (0..4)
                .map(|k| (tangent[k] - wanted[k]).abs())
                .fold(0.0, f32::max);
            assert!(f64::from(off) < TANGENT, "{tangent:?}");
        }
    }
}

#[test]
fn projected_shapes_have_right_handed_tangents() {
    for name in ["cube", "sphere", "kettle"] {
        let scene = shape(name, "normal_map");
        for mesh in &scene.meshes {
            check_tangents(mesh);
            assert!(
                mesh.tangents.iter().all(|tangent| tangent[3] == 1.0),
                "{name}"
            );
        }
    }
}

#[test]
fn coordinates_without_an_area_still_have_tangents() {
    for coordinates in [
        "vt 0 0\n".repeat(4),
        "vt 0 0\nvt 1 1\nvt 2 2\nvt 3 3\n".to_owned(),
        "vt 1e12 -1e12\nvt -1e12 1e12\nvt 1e12 1e12\nvt 0 0\n".to_owned(),
        "vt 1e-40 0\nvt 0 1e-40\nvt 0 0\nvt 0 0\n".to_owned(),
    ] {
        let text = format!("mtllib m.mtl\n{SQUARE}{coordinates}usemtl m\nf 1/1 2/2 3/3 4/4\n");
        let scene = load(&text, NORMALS).expect("a good model");
        check_tangents(&scene.meshes[0]);
    }
}

const RICH: &str = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0.5\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1e3 1\nvt -1 2\n\
                    vn 0 0 1\no a\nusemtl m\nf 1/1 2/2 3/3 4/4\nf 1/2/1 3//1 4/-1/1\no b\nf 4 3 2\n";

proptest! {
    #![proptest_config(mutation::cases(1000))]

    /// Whatever happens to the text, the lists are parallel and the tangents are tangents.
    #[test]
    fn mutated_coordinates_never_panic(bytes in mutation::mutated(RICH, b"- 9/vt.e#")) {
        let text = String::from_utf8_lossy(&bytes);
        match load(&text, "map_Kd n.png\nnorm n.png\n") {
            Err(error) => prop_assert!(error.to_string().contains("model.obj"), "{}", error),
            Ok(scene) => for object in &scene.objects {
                let mesh = &scene.meshes[object.mesh];
                if scene.materials[object.material].maps.normal.is_some() {
                    check_tangents(mesh);
                    let mut numbers = mesh.coordinates.iter().flatten();
                    prop_assert!(numbers.all(|x| x.is_finite()));
                }
            }
        }
    }
}
