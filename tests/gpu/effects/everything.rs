//! Which small scene calls for any effects that a test wants, and for no others?
//!
//! Two boards stand side by side, the left one plain, the right one of the material that calls; a block in front of them
//! throws a shadow on both, and they face the eye.

use glam::{Affine3A, Quat, Vec3};
use umber::render::effects::ALL;
use umber::scene::{
    Ambient, Camera, Light, LightKind, Maps, Material, Mesh, Object, Projection, Scene, Slot,
    Texture,
};

/// The scene that calls for the effects at these places of [`ALL`]. Some bring others with them: a rough base has a
/// base, a map has what it changes.
pub fn scene_with(effects: &[usize]) -> Scene {
    let wants = &|name: &str| effects.iter().any(|place| ALL[*place].name == name);
    let mut scene = plain();
    let special = &mut scene.materials[1];
    let on_the_base = [
        "diffuse-lobe",
        "rough-diffuse",
        "base-color-map",
        "normal-map",
        "occlusion-map",
    ];
    if on_the_base.into_iter().any(wants) {
        special.albedo = [0.6, 0.5, 0.4];
    }
    if wants("specular-lobe") || wants("colored-f0") || wants("roughness-map") {
        special.f0 = [0.3; 3];
        special.roughness = 0.4;
    }
    if wants("colored-f0") {
        special.f0 = [0.9, 0.7, 0.3];
    }
    if wants("rough-diffuse") {
        special.roughness = 0.7;
    }
    if wants("metalness-map") {
        special.albedo = [0.6, 0.5, 0.4];
        special.roughness = 0.4;
    }
    if wants("emission") || wants("emission-map") {
        special.emission = [0.2, 0.4, 0.1];
    }
    if wants("transparency") {
        special.opacity = 0.4;
    }
    if wants("two-sided") {
        special.two_sided = true;
        // Turned away: its back is seen.
        scene.objects[1].transform *= Affine3A::from_rotation_y(2.8);
    }
    special.maps = maps(&mut scene.textures, wants);
    lamps(&mut scene.lights, wants);
    scene
}

fn plain() -> Scene {
    let matte = Material {
        name: "plain".into(),
        albedo: [0.5; 3],
        f0: [0.0; 3],
        roughness: 0.0,
        two_sided: false,
        ..Material::default()
    };
    let special = Material {
        name: "special".into(),
        // Nothing of its own: what it has, a test asked for. It is seen against the board behind.
        albedo: [0.0; 3],
        ..matte.clone()
    };
    let object = |name: &str, material, transform| Object {
        name: name.into(),
        mesh: 0,
        material,
        transform,
    };
    let at = |x, y, z, size| {
        Affine3A::from_scale_rotation_translation(
            Vec3::splat(size),
            Quat::from_rotation_y(0.3),
            Vec3::new(x, y, z),
        )
    };
    Scene {
        camera: Camera {
            position: Vec3::new(0.0, 0.0, 4.0),
            target: Vec3::ZERO,
            up: Vec3::Y,
            projection: Projection::Perspective {
                vertical_fov_degrees: 40.0,
            },
            exposure_ev100: 0.0,
        },
        ambient: Ambient {
            sky: [0.3; 3],
            ground: [0.1; 3],
        },
        lights: vec![
            lamp(LightKind::Directional {
                direction: Vec3::new(-0.3, -0.2, -1.0).normalize(),
                illuminance: 2.0,
                angular_diameter_degrees: 0.5,
            }),
            lamp(LightKind::Directional {
                direction: Vec3::new(0.5, -0.4, -1.0).normalize(),
                illuminance: 1.0,
                angular_diameter_degrees: 2.0,
            }),
        ],
        materials: vec![matte, special],
        meshes: vec![board()],
        objects: vec![
            object("back", 0, at(0.0, 0.0, -1.0, 2.4)),
            object("board", 1, at(0.3, 0.0, 0.0, 1.2)),
            object("block", 0, at(-0.1, 0.2, 0.5, 0.3)),
        ],
        textures: Vec::new(),
        warnings: Vec::new(),
    }
}

fn lamp(kind: LightKind) -> Light {
    Light {
        name: "lamp".into(),
        color: [1.0, 0.9, 0.8],
        kind,
        shadow: false,
    }
}

/// A square of side 1, facing +z, its normals spread as those of a shallow bowl.
fn board() -> Mesh {
    let corners = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]];
    let normal = |[x, y]: [f32; 2]| Vec3::new(0.6 * x, 0.6 * y, 1.0).normalize();
    let tangent = |corner| {
        let normal: Vec3 = normal(corner);
        normal.cross(Vec3::X.cross(normal)).normalize().extend(1.0)
    };
    Mesh {
        name: "board".into(),
        positions: corners.map(|[x, y]| [x, y, 0.0]).to_vec(),
        normals: corners.map(|corner| normal(corner).to_array()).to_vec(),
        indices: vec![0, 1, 2, 0, 2, 3],
        coordinates: corners.map(|[x, y]| [x + 0.5, y + 0.5]).to_vec(),
        tangents: corners.map(|corner| tangent(corner).to_array()).to_vec(),
    }
}

fn maps(textures: &mut Vec<Texture>, wants: &dyn Fn(&str) -> bool) -> Maps {
    let mut maps = Maps {
        repeat: [1.5, 2.0],
        ..Maps::default()
    };
    for (name, slot, place) in [
        ("base-color-map", Slot::BaseColor, &mut maps.base_color),
        ("roughness-map", Slot::Roughness, &mut maps.roughness),
        ("metalness-map", Slot::Metalness, &mut maps.metalness),
        ("normal-map", Slot::Normal, &mut maps.normal),
        ("emission-map", Slot::Emission, &mut maps.emission),
        ("occlusion-map", Slot::Occlusion, &mut maps.occlusion),
        ("alpha-mask", Slot::AlphaMask, &mut maps.alpha_mask),
    ] {
        if wants(name) {
            *place = Some(textures.len());
            textures.push(texture(name, slot));
        }
    }
    maps
}

/// 4 x 4 texels of all sizes of numbers.
fn texture(name: &str, slot: Slot) -> Texture {
    let texel = |i: u32| {
        let share = |k: u32| ((i * 7 + k * 5) % 16) as f32 / 15.0;
        match slot {
            Slot::Normal => [share(0) - 0.5, share(1) - 0.5, 1.0, 1.0],
            _ => [share(0), share(1), share(2), 1.0],
        }
    };
    let texels: Vec<_> = (0..16).map(texel).collect();
    match Texture::from_linear(name, slot, 4, 4, &texels) {
        Some(texture) => texture,
        None => panic!("{name}: no texture"),
    }
}

fn lamps(lights: &mut [Light], wants: &dyn Fn(&str) -> bool) {
    if wants("point-light") {
        lights[0].kind = LightKind::Point {
            position: Vec3::new(0.5, 0.7, 2.0),
            intensity: 6.0,
            radius: 0.05,
        };
    }
    if wants("spot-light") {
        lights[1].kind = LightKind::Spot {
            position: Vec3::new(-0.8, 0.6, 2.0),
            direction: Vec3::new(0.4, -0.3, -1.0).normalize(),
            intensity: 6.0,
            radius: 0.05,
            inner_degrees: 10.0,
            outer_degrees: 25.0,
        };
    }
    if wants("shadow") {
        for light in lights {
            light.shadow = true;
        }
    }
}
