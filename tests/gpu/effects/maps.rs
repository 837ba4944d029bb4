//! Does a map change what it says, by as much as it says?
//!
//! A map of one value makes of a material what another material's numbers are: both are drawn, and the pixels compared.

use glam::{Mat3A, Vec3};
use umber::reference::shade::Lighting;
use umber::scene::{Maps, Material, Scene, Slot, Texture};

use crate::harness::{whole, with_gpu};
use crate::patches::{Patch, Patches, material, towards};
use crate::tolerances::MAPPED_PIXEL;
use umber::scene::Ambient;

fn uniform(slot: Slot, value: [f32; 3]) -> Texture {
    let [r, g, b] = value;
    let texels = vec![[r, g, b, 1.0]; 16];
    match Texture::from_linear("uniform", slot, 4, 4, &texels) {
        Some(texture) => texture,
        None => panic!("no texture"),
    }
}

fn base() -> Material {
    Material {
        emission: [0.3, 0.2, 0.1],
        ..material([0.6, 0.4, 0.2], [0.05; 3], 0.6)
    }
}

/// Patches of these normals, of one material, with coordinates and tangents on each.
fn scene(material: &Material, normals: &[Vec3], textures: Vec<Texture>) -> (Scene, (u32, u32)) {
    let patches = Patches {
        to_eye: Vec3::new(0.1, 0.2, 1.0).normalize(),
        lights: vec![
            towards(Vec3::new(0.4, 0.5, 0.8).normalize(), [1.0, 0.9, 0.8]),
            towards(Vec3::new(-0.7, 0.1, 0.6).normalize(), [0.3, 0.5, 0.7]),
        ],
        ambient: Ambient {
            sky: [0.4, 0.5, 0.6],
            ground: [0.2, 0.1, 0.1],
        },
        patches: normals
            .iter()
            .map(|&normal| Patch {
                normal,
                material: material.clone(),
            })
            .collect(),
    };
    let mut scene = patches.scene();
    scene.textures = textures;
    for (mesh, normal) in scene.meshes.iter_mut().zip(normals) {
        let tangent = normal.any_orthonormal_vector();
        mesh.coordinates = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        mesh.tangents = vec![tangent.extend(1.0).to_array(); 4];
    }
    (scene, patches.size())
}

fn normals() -> Vec<Vec3> {
    (0..25_u8)
        .map(|i| {
            let (x, y) = (f32::from(i % 5) - 2.0, f32::from(i / 5) - 2.0);
            Vec3::new(0.3 * x, 0.3 * y, 1.0).normalize()
        })
        .collect()
}

/// Draws two scenes of one size and asserts that each value of the first is that of the second.
fn assert_pixels(scenes: [Scene; 2], size: (u32, u32), what: &str) {
    let [got, want] =
        scenes.map(|scene| with_gpu(|gpu| gpu.render(&scene, size, whole(Lighting::CORRECTED))));
    let want = want.pixels.as_flattened().iter();
    for (got, want) in got.pixels.as_flattened().iter().zip(want) {
        let holds = MAPPED_PIXEL.holds(f64::from(*got), f64::from(*want));
        assert!(holds, "{what}: {got} for {want}");
    }
}

/// Asserts that the material under its maps is drawn as `numbers` is without any.
fn assert_drawn_as(mapped: &Material, textures: Vec<Texture>, numbers: &Material) {
    let plain = Material {
        maps: Maps::default(),
        ..numbers.clone()
    };
    let (under_maps, size) = scene(mapped, &normals(), textures);
    let (without, _) = scene(&plain, &normals(), Vec::new());
    assert_pixels([under_maps, without], size, &format!("{mapped:?}"));
}

fn with_map(slot: Slot, change: impl Fn(&mut Material)) -> Material {
    let mut mapped = base();
    let place = match slot {
        Slot::BaseColor => &mut mapped.maps.base_color,
        Slot::Roughness => &mut mapped.maps.roughness,
        Slot::Metalness => &mut mapped.maps.metalness,
        Slot::Normal => &mut mapped.maps.normal,
        Slot::Emission => &mut mapped.maps.emission,
        Slot::Occlusion => &mut mapped.maps.occlusion,
        Slot::AlphaMask => &mut mapped.maps.alpha_mask,
    };
    *place = Some(0);
    change(&mut mapped);
    mapped
}

#[test]
fn a_base_colour_multiplies_the_albedo() {
    let value = [0.8, 0.25, 0.02];
    let numbers = Material {
        albedo: [0, 1, 2].map(|c| base().albedo[c] * value[c]),
        ..base()
    };
    let mapped = with_map(Slot::BaseColor, |_| {});
    let textures = vec![uniform(Slot::BaseColor, value)];
    assert_drawn_as(&mapped, textures, &numbers);
}

#[test]
fn a_roughness_multiplies_the_roughness() {
    let numbers = Material {
        roughness: 0.3,
        ..base()
    };
    let mapped = with_map(Slot::Roughness, |_| {});
    let textures = vec![uniform(Slot::Roughness, [0.5; 3])];
    assert_drawn_as(&mapped, textures, &numbers);
}

#[test]
fn a_metalness_moves_the_base_into_the_interface() {
    // 0.75 of the map's 0.8.
    let metalness = 0.6;
    let numbers = Material {
        albedo: base().albedo.map(|albedo| albedo * (1.0 - metalness)),
        f0: [0, 1, 2].map(|c| {
            let (f0, albedo) = (base().f0[c], base().albedo[c]);
            f0 + (albedo - f0) * metalness
        }),
        ..base()
    };
    let mapped = with_map(Slot::Metalness, |m| m.metalness = 0.75);
    let textures = vec![uniform(Slot::Metalness, [0.8; 3])];
    assert_drawn_as(&mapped, textures, &numbers);
}

#[test]
fn an_emission_multiplies_the_emission_beyond_one() {
    let value = [0.5, 3.0, 40.0];
    let numbers = Material {
        emission: [0, 1, 2].map(|c| base().emission[c] * value[c]),
        ..base()
    };
    let mapped = with_map(Slot::Emission, |_| {});
    let textures = vec![uniform(Slot::Emission, value)];
    assert_drawn_as(&mapped, textures, &numbers);
}

#[test]
fn an_occlusion_dims_what_comes_from_around_and_no_lamp() {
    let mapped = with_map(Slot::Occlusion, |_| {});
    let normals = normals();
    let draw = |material: &Material, textures, ambient: bool, lamps: bool| {
        let (mut scene, size) = scene(material, &normals, textures);
        if !ambient {
            scene.ambient = Ambient::default();
        }
        if !lamps {
            scene.lights.clear();
        }
        with_gpu(|gpu| gpu.render(&scene, size, whole(Lighting::CORRECTED)))
    };
    let textures = || vec![uniform(Slot::Occlusion, [0.2; 3])];
    let dark = Material {
        emission: [0.0; 3],
        ..mapped
    };
    let plain = Material {
        maps: Maps::default(),
        ..dark.clone()
    };
    let open = draw(&plain, Vec::new(), true, false);
    let dimmed = draw(&dark, textures(), true, false);
    for (dimmed, open) in dimmed.pixels.iter().zip(&open.pixels) {
        for c in 0..3 {
            let (dimmed, open) = (f64::from(dimmed[c]), f64::from(open[c]));
            assert!(MAPPED_PIXEL.holds(dimmed, 0.2 * open), "{dimmed} of {open}");
        }
    }
    let lit = draw(&plain, Vec::new(), false, true);
    let lit_under_map = draw(&dark, textures(), false, true);
    assert!(lit.max_difference(&lit_under_map) <= 1e-6);
}

#[test]
fn an_alpha_mask_leaves_no_surface_below_its_cutoff() {
    for (value, cutoff, there) in [(0.4, 0.5, false), (0.6, 0.5, true), (0.6, 0.7, false)] {
        let mapped = with_map(Slot::AlphaMask, |m| m.alpha_cutoff = cutoff);
        let (scene, size) = scene(
            &mapped,
            &normals(),
            vec![uniform(Slot::AlphaMask, [value; 3])],
        );
        let picture = with_gpu(|gpu| gpu.render(&scene, size, whole(Lighting::CORRECTED)));
        let covered = picture.pixels.iter().filter(|pixel| pixel[3] > 0.0).count();
        let want = if there { picture.pixels.len() } else { 0 };
        assert_eq!(covered, want, "{value} under {cutoff}");
    }
}

/// A way to stand: what is done to the patches with the map, and the signs of the bent normal's x and y that follow.
struct Stance {
    name: &'static str,
    change: fn(&mut Scene),
    signs: [f32; 2],
}

/// Mirrors each patch in its own plane; normals and tangents of the mesh so that those of the world are as before.
fn mirror(scene: &mut Scene) {
    for (mesh, object) in scene.meshes.iter_mut().zip(&mut scene.objects) {
        let corner = |i: usize| Vec3::from_array(mesh.positions[i]);
        let right = (corner(1) - corner(0)).normalize();
        let reflect = |v: Vec3| v - 2.0 * right * right.dot(v);
        let columns = [Vec3::X, Vec3::Y, Vec3::Z].map(reflect);
        object.transform.matrix3 =
            Mat3A::from_cols(columns[0].into(), columns[1].into(), columns[2].into());
        for normal in &mut mesh.normals {
            *normal = reflect(Vec3::from_array(*normal)).to_array();
        }
        for tangent in &mut mesh.tangents {
            let [x, y, z, w] = *tangent;
            *tangent = reflect(Vec3::new(x, y, z)).extend(w).to_array();
        }
    }
}

/// Turns each patch's back to the eye: its corners the other way round, its normals away.
fn turn_back(scene: &mut Scene) {
    for mesh in &mut scene.meshes {
        mesh.indices.reverse();
        for normal in &mut mesh.normals {
            *normal = normal.map(|x| -x);
        }
    }
}

fn left_handed(scene: &mut Scene) {
    for tangent in scene.meshes.iter_mut().flat_map(|mesh| &mut mesh.tangents) {
        tangent[3] = -1.0;
    }
}

const STANCES: [Stance; 4] = [
    Stance {
        name: "as it is",
        change: |_| (),
        signs: [1.0, 1.0],
    },
    Stance {
        name: "a mirrored picture",
        change: left_handed,
        signs: [1.0, -1.0],
    },
    Stance {
        name: "a mirrored object",
        change: mirror,
        signs: [1.0, -1.0],
    },
    // Turned to the eye again, all three axes change sign; the bitangent has changed it before, with the normal.
    Stance {
        name: "from behind",
        change: turn_back,
        signs: [-1.0, 1.0],
    },
];

#[test]
fn a_normal_map_turns_the_normal_in_the_frame_of_the_tangent() {
    let bent = Vec3::new(0.3, -0.4, 0.8).normalize();
    let mapped = with_map(Slot::Normal, |m| m.normal_scale = 1.0);
    for stance in STANCES {
        let [x, y] = [bent.x * stance.signs[0], bent.y * stance.signs[1]];
        let turned: Vec<_> = normals()
            .iter()
            .map(|normal| {
                let tangent = normal.any_orthonormal_vector();
                tangent * x + normal.cross(tangent) * y + *normal * bent.z
            })
            .collect();
        let textures = vec![uniform(Slot::Normal, bent.to_array())];
        let (mut scene_mapped, size) = scene(&mapped, &normals(), textures);
        (stance.change)(&mut scene_mapped);
        let (scene_turned, _) = scene(&base(), &turned, Vec::new());
        assert_pixels([scene_mapped, scene_turned], size, stance.name);
    }
}

#[test]
fn a_normal_map_flattened_by_its_factor_is_the_plain_normal() {
    let bent = Vec3::new(0.3, -0.4, 0.8).normalize();
    let flat = with_map(Slot::Normal, |m| m.normal_scale = 1e-6);
    let textures = vec![uniform(Slot::Normal, bent.to_array())];
    let (scene_flat, size) = scene(&flat, &normals(), textures);
    let (scene_plain, _) = scene(&base(), &normals(), Vec::new());
    let [got, want] = [scene_flat, scene_plain]
        .map(|scene| with_gpu(|gpu| gpu.render(&scene, size, whole(Lighting::CORRECTED))));
    assert!(got.max_difference(&want) < 1e-5);
}

#[test]
fn maps_of_three_sizes_are_each_found() {
    let glow = |side: u32, value: f32| {
        let texels = vec![[value, value, value, 1.0]; (side * side) as usize];
        Texture::from_linear("glow", Slot::Emission, side, side, &texels)
    };
    // Too large together to share one array.
    let sides = [(256, 0.25), (1024, 0.5), (4096, 0.75)];
    let textures: Vec<_> = sides
        .iter()
        .filter_map(|(side, value)| glow(*side, *value))
        .collect();
    assert_eq!(textures.len(), 3);
    let lamp = Material {
        emission: [1.0; 3],
        ..material([0.0; 3], [0.0; 3], 0.0)
    };
    let (mut scene, size) = scene(&lamp, &[Vec3::Z; 3], textures);
    for (number, material) in scene.materials.iter_mut().enumerate() {
        material.maps.emission = Some(number);
    }
    scene.ambient = Ambient::default();
    scene.lights.clear();
    let picture = with_gpu(|gpu| gpu.render(&scene, size, whole(Lighting::CORRECTED)));
    let mut seen: Vec<_> = picture.pixels.iter().map(|pixel| pixel[0]).collect();
    seen.retain(|value| *value > 0.0);
    seen.dedup();
    // Two patches in the upper row, of three lines each, and one in the lower.
    let rows = [[0.25, 0.5], [0.25, 0.5], [0.25, 0.5]].concat();
    assert_eq!(seen, [rows, vec![0.75]].concat());
}

#[test]
fn a_map_lies_upright_and_repeats_as_often_as_it_should() {
    // Left column dark, right one bright in the upper row; the other way round in the lower.
    let texels = [0.1_f32, 0.9, 0.6, 0.3].map(|v| [v, v, v, 1.0]);
    let texture = Texture::from_linear("quarters", Slot::Emission, 2, 2, &texels);
    let textures: Vec<_> = texture.into_iter().collect();
    assert_eq!(textures.len(), 1);
    let mut mapped = Material {
        emission: [1.0; 3],
        ..material([0.0; 3], [0.0; 3], 0.0)
    };
    mapped.maps.emission = Some(0);
    // One patch of 3 x 3 pixels: with 1.5 repeats each way its pixels lie in the middles of texels.
    mapped.maps.repeat = [1.5, 1.5];
    let (scene, size) = scene(&mapped, &[Vec3::Z], textures);
    let picture = with_gpu(|gpu| gpu.render(&scene, size, whole(Lighting::CORRECTED)));
    let rows: Vec<Vec<f32>> = (0..3)
        .map(|y| (0..3).map(|x| picture.at(x, y)[0]).collect())
        .collect();
    // v = 0 is the lower edge of the patch and of the picture.
    let want = [[0.6, 0.3, 0.6], [0.1, 0.9, 0.1], [0.6, 0.3, 0.6]];
    for (row, want) in rows.iter().zip(want) {
        for (got, want) in row.iter().zip(want) {
            assert!((got - want).abs() < 0.01, "{rows:?}");
        }
    }
}
