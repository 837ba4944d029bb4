//! Do surfaces without normals become smooth where they are smooth, and stay sharp at creases?

use std::fmt::Write;
use std::fs;

use glam::Vec3;
use umber::scene::{self, LoadOptions, Mesh};

/// The one mesh of an OBJ text.
fn mesh(text: &str) -> Mesh {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("model.obj");
    fs::write(&path, text).expect("a written file");
    let mut scene = scene::load(&path, &LoadOptions::default()).expect("a good model");
    assert_eq!(scene.meshes.len(), 1);
    let mesh = scene.meshes.remove(0);
    assert_eq!(mesh.positions.len(), mesh.normals.len());
    for normal in &mesh.normals {
        let length = Vec3::from_array(*normal).length();
        assert!((length - 1.0).abs() < 1e-6, "a normal of length {length}");
    }
    mesh
}

/// The distinct normals at a position.
fn normals_at(mesh: &Mesh, position: [f32; 3]) -> Vec<Vec3> {
    let mut found: Vec<Vec3> = Vec::new();
    for (at, normal) in mesh.positions.iter().zip(&mesh.normals) {
        let normal = Vec3::from_array(*normal);
        if *at == position && !found.iter().any(|other| other.distance(normal) < 1e-6) {
            found.push(normal);
        }
    }
    found
}

const CUBE: &str = "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\n\
                    v -1 1 1\nf 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

#[test]
fn a_cube_stays_sharp() {
    let mesh = mesh(CUBE);
    assert_eq!(mesh.triangle_count(), 12);
    assert_eq!(
        mesh.positions.len(),
        24,
        "four for each face, shared by its two triangles"
    );
    let corner = normals_at(&mesh, [1.0, 1.0, 1.0]);
    assert_eq!(corner.len(), 3);
    for axis in [Vec3::X, Vec3::Y, Vec3::Z] {
        assert!(corner.contains(&axis), "{corner:?}");
    }
}

/// The side of a prism around the z axis.
fn prism(sides: usize) -> String {
    let mut text = String::new();
    for side in 0..sides {
        let (sin, cos) = (side as f64 / sides as f64 * std::f64::consts::TAU).sin_cos();
        writeln!(text, "v {cos} {sin} 0\nv {cos} {sin} 1").expect("memory");
    }
    for side in 0..sides {
        let (a, b) = (2 * side + 1, 2 * ((side + 1) % sides) + 1);
        writeln!(text, "f {a} {b} {} {}", b + 1, a + 1).expect("memory");
    }
    text
}

#[test]
fn edges_are_smooth_below_forty_degrees_and_sharp_above() {
    // 360 / 10 = 36 degrees per side, and 360 / 8 = 45.
    let round = mesh(&prism(10));
    let at = normals_at(&round, [1.0, 0.0, 0.0]);
    assert_eq!(at.len(), 1, "{at:?}");
    assert!(
        at[0].distance(Vec3::X) < 1e-5,
        "between its two sides: {}",
        at[0]
    );
    let sharp = mesh(&prism(8));
    assert_eq!(normals_at(&sharp, [1.0, 0.0, 0.0]).len(), 2);
}

#[test]
fn the_cut_into_triangles_does_not_turn_a_normal() {
    // A ridge: two planes that meet at the y axis with 30 degrees between their normals. The left
    // one is cut into many slivers at the origin; weighting by the corner's angle, the normal there
    // still stands in the middle. Without weights it would lean far to the left.
    let slope = 15_f64.to_radians().tan();
    let mut text = String::from("v 0 0 0\nv 0 -1 0\nv 0 1 0\n");
    writeln!(text, "v 1 0 {}", -slope).expect("memory");
    text.push_str("f 1 2 4\nf 1 4 3\n");
    let slivers = 24;
    for number in 1..slivers {
        let angle = f64::from(number) / f64::from(slivers) * std::f64::consts::PI;
        let (x, y) = (-angle.sin(), angle.cos());
        writeln!(text, "v {x} {y} {}", x * slope).expect("memory");
    }
    let first = 5;
    let mut ring = vec![3];
    ring.extend((0..slivers - 1).map(|number| first + number));
    ring.push(2);
    for pair in ring.windows(2) {
        writeln!(text, "f 1 {} {}", pair[0], pair[1]).expect("memory");
    }
    let mesh = mesh(&text);
    let at = normals_at(&mesh, [0.0; 3]);
    assert_eq!(at.len(), 1, "{at:?}");
    // Measured in the slope's plane the slivers' angles differ from the flat ones by at most the
    // cosine of 15 degrees, evenly on both sides of the middle.
    assert!(at[0].x.abs() < 1e-3, "leans by {}", at[0].x);
    assert!(at[0].z > 0.9);
}

#[test]
fn vertices_at_one_place_count_as_one_point() {
    // Two triangles in one plane which share an edge's ends by place, not by number.
    let mesh = mesh("v 0 0 0\nv 1 0 0\nv 0 1 0.1\nv 1 0 0\nv 1 1 0\nv 0 1 0.1\nf 1 2 3\nf 4 5 6\n");
    assert_eq!(normals_at(&mesh, [1.0, 0.0, 0.0]).len(), 1, "no seam");
    assert_eq!(mesh.positions.len(), 4, "and no vertex twice");
}

#[test]
fn the_two_sides_of_a_sheet_keep_their_own_normals() {
    let mesh = mesh("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 3 2 1\n");
    let mut at = normals_at(&mesh, [0.0; 3]);
    at.sort_by(|a, b| a.z.total_cmp(&b.z));
    assert_eq!(at, [Vec3::NEG_Z, Vec3::Z]);
}

#[test]
fn given_normals_are_kept_and_gaps_are_filled() {
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 3 4\nvn 0 0 0\n\
                f 1//1 2//1 3\nf 1//1 3//2 4//1\n";
    let mesh = mesh(text);
    let kept = normals_at(&mesh, [0.0, 0.0, 0.0]);
    assert_eq!(kept.len(), 1);
    assert!(
        kept[0].distance(Vec3::new(0.0, 0.6, 0.8)) < 1e-6,
        "made unit: {kept:?}"
    );
    // One corner has no normal, the other a zero one: both get the face's.
    assert_eq!(normals_at(&mesh, [1.0, 1.0, 0.0]), [Vec3::Z]);
}

#[test]
fn a_fan_of_very_many_triangles_ends_in_time() {
    // A point with fifty thousand triangles: a loop over their pairs would take 2.5e9 steps.
    let count = 50_000;
    let mut text = String::from("v 0 0 0\n");
    for number in 0..count {
        let (sin, cos) = (f64::from(number) / f64::from(count) * std::f64::consts::TAU).sin_cos();
        writeln!(text, "v {cos:.9} {sin:.9} 0").expect("memory");
    }
    for number in 0..count {
        writeln!(text, "f 1 {} {}", number + 2, (number + 1) % count + 2).expect("memory");
    }
    // And an edge with very many faces.
    for number in 0..count {
        writeln!(text, "v 0 0 {}\nf 1 2 -1", number + 1).expect("memory");
    }
    let began = std::time::Instant::now();
    let mesh = mesh(&text);
    assert!(mesh.triangle_count() >= count as usize);
    assert!(began.elapsed().as_secs() < 10, "{:?}", began.elapsed());
}

#[test]
fn minus_zero_is_zero() {
    let mesh =
        mesh("v 0 0 0\nv 1 0 0\nv 0 1 0.1\nv 1 -0 0\nv 1 1 0\nv -0 1 0.1\nf 1 2 3\nf 4 5 6\n");
    assert_eq!(normals_at(&mesh, [1.0, 0.0, 0.0]).len(), 1, "no seam");
}

#[test]
fn a_third_face_on_an_edge_does_not_part_the_other_two() {
    let mesh = mesh("v 0 0 0\nv 0 0 1\nv 1 0 0\nv 0 1 0\nv -1 0.1 0\nf 1 2 3\nf 1 2 4\nf 1 5 2\n");
    assert_eq!(normals_at(&mesh, [0.0; 3]).len(), 2);
}
