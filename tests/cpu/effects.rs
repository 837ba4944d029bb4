//! Does each effect cost nothing where nobody calls for it, and is it called for by the right things alone?

use std::path::Path;

use glam::{Affine3A, Vec3};
use umber::render::effects::{ALL, Build, Caller, Census, Effect, EffectSet, Effects};
use umber::scene::{
    Ambient, Camera, Light, LightKind, Maps, Material, Mesh, Object, Projection, Scene,
};

use crate::optimised::{assert_vanishes, what_is_left};

fn shaders() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders-glsl")
}

fn file(effect: &Effect) -> String {
    format!("effects/{}.glsl", effect.name.replace('-', "_"))
}

fn constant(effect: &Effect) -> String {
    format!("EFFECT_{}", effect.name.replace('-', "_").to_uppercase())
}

/// The value of `LIGHTING_CORRECTED`, the model in which every effect has a part.
const CORRECTED: (&str, i32) = ("LIGHTING", 2);

#[test]
fn an_effect_that_is_off_leaves_nothing_in_the_surface_shader() {
    for effect in &ALL {
        assert_vanishes(
            &shaders(),
            "surface.frag",
            &file(effect),
            &constant(effect),
            &[CORRECTED],
        );
    }
}

/// What is left of each effect that is off where all others have one value. Where they are off as well, its being on may
/// not show: a map of what is not there changes nothing.
fn left_beside(value: i32) -> Vec<String> {
    let beside = |effect: &Effect| {
        let others = ALL.iter().filter(|other| other.name != effect.name);
        let names: Vec<_> = others.map(constant).collect();
        let frozen: Vec<_> = names.iter().map(|name| (name.as_str(), value)).collect();
        let frozen = [&frozen[..], &[CORRECTED]].concat();
        what_is_left(
            &shaders(),
            "surface.frag",
            &file(effect),
            &constant(effect),
            &frozen,
        )
    };
    let lines = ALL.iter().flat_map(beside);
    lines
        .filter(|line| value != 0 || !line.contains("changes nothing"))
        .collect()
}

#[test]
fn an_effect_that_is_off_leaves_nothing_beside_effects_that_are_on() {
    assert_eq!(left_beside(1), [""; 0]);
}

#[test]
fn an_effect_that_is_off_leaves_nothing_where_all_are() {
    assert_eq!(left_beside(0), [""; 0]);
}

#[test]
fn a_hook_in_another_stage_vanishes_too() {
    for (entry, name) in [
        ("surface.vert", "normal-map"),
        ("shadow.frag", "alpha-mask"),
    ] {
        let Some(effect) = ALL.iter().find(|effect| effect.name == name) else {
            panic!("no effect {name}");
        };
        assert_vanishes(&shaders(), entry, &file(effect), &constant(effect), &[]);
    }
}

#[test]
fn each_effect_has_its_file_and_each_file_its_effect() {
    let mut files: Vec<_> = std::fs::read_dir(shaders().join("effects"))
        .expect("a folder of effects")
        .map(|item| {
            item.expect("a name")
                .file_name()
                .to_string_lossy()
                .into_owned()
        })
        .filter(|name| name != "called_for.glsl")
        .collect();
    files.sort();
    let mut wanted: Vec<_> = ALL
        .iter()
        .map(|effect| file(effect).replace("effects/", ""))
        .collect();
    wanted.sort();
    assert_eq!(files, wanted);
}

/// A scene that calls for nothing but the matte base: one smooth, opaque, one-sided, black-faced material under
/// a far lamp.
fn plain() -> Scene {
    Scene {
        camera: Camera {
            position: Vec3::Z,
            target: Vec3::ZERO,
            up: Vec3::Y,
            projection: Projection::Orthographic { height: 1.0 },
            exposure_ev100: 0.0,
        },
        ambient: Ambient::default(),
        lights: vec![light(LightKind::Directional {
            direction: Vec3::NEG_Z,
            illuminance: 1.0,
            angular_diameter_degrees: 0.5,
        })],
        materials: vec![matte()],
        meshes: vec![Mesh {
            positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            normals: vec![[0.0, 0.0, 1.0]; 3],
            indices: vec![0, 1, 2],
            ..Mesh::default()
        }],
        objects: vec![Object {
            name: "thing".into(),
            mesh: 0,
            material: 0,
            transform: Affine3A::IDENTITY,
        }],
        textures: Vec::new(),
        warnings: Vec::new(),
    }
}

fn light(kind: LightKind) -> Light {
    Light {
        name: "lamp".into(),
        color: [1.0; 3],
        kind,
        shadow: false,
    }
}

fn matte() -> Material {
    Material {
        name: "stuff".into(),
        albedo: [0.5; 3],
        f0: [0.0; 3],
        roughness: 0.0,
        two_sided: false,
        ..Material::default()
    }
}

fn called_for(scene: &Scene) -> String {
    Census::of(scene).called_for().to_string()
}

fn with_material(change: impl Fn(&mut Material)) -> Scene {
    let mut scene = plain();
    change(&mut scene.materials[0]);
    scene
}

#[test]
fn a_matte_surface_under_a_far_lamp_calls_for_the_base_alone() {
    assert_eq!(called_for(&plain()), "diffuse-lobe");
    let black = with_material(|m| m.albedo = [0.0; 3]);
    assert_eq!(called_for(&black), "");
}

fn with_lamp(kind: LightKind) -> Scene {
    let mut scene = plain();
    scene.lights[0] = light(kind);
    scene
}

fn with_maps(change: fn(&mut Maps)) -> Scene {
    with_material(|m| {
        m.roughness = 0.5;
        m.emission = [1.0; 3];
        change(&mut m.maps);
    })
}

#[test]
fn each_number_of_a_material_calls_for_its_own_effect() {
    let cases = [
        (with_material(|m| m.f0 = [0.04; 3]), "specular-lobe"),
        (
            with_material(|m| m.f0 = [0.04, 0.04, 0.05]),
            "specular-lobe,colored-f0",
        ),
        (with_material(|m| m.roughness = 0.1), "rough-diffuse"),
        (with_material(|m| m.emission = [0.0, 0.0, 0.1]), "emission"),
        (with_material(|m| m.opacity = 0.99), "transparency"),
        (with_material(|m| m.two_sided = true), "two-sided"),
    ];
    for (scene, want) in cases {
        assert_eq!(called_for(&scene), format!("diffuse-lobe,{want}"));
    }
}

#[test]
fn each_kind_of_lamp_calls_for_its_own_effect() {
    let position = Vec3::Z;
    let point = LightKind::Point {
        position,
        intensity: 1.0,
        radius: 0.1,
    };
    let spot = LightKind::Spot {
        position,
        direction: Vec3::NEG_Z,
        intensity: 1.0,
        radius: 0.1,
        inner_degrees: 10.0,
        outer_degrees: 20.0,
    };
    let mut shadow = plain();
    shadow.lights[0].shadow = true;
    let cases = [
        (with_lamp(point), "point-light"),
        (with_lamp(spot), "point-light,spot-light"),
        (shadow, "shadow"),
    ];
    for (scene, want) in cases {
        assert_eq!(called_for(&scene), format!("diffuse-lobe,{want}"));
    }
}

#[test]
fn each_map_calls_for_its_own_effect() {
    let base = "diffuse-lobe,rough-diffuse,emission";
    type Change = fn(&mut Maps);
    let cases: [(Change, &str); 6] = [
        (|m| m.base_color = Some(0), "base-color-map"),
        (|m| m.roughness = Some(0), "roughness-map"),
        (|m| m.normal = Some(0), "normal-map"),
        (|m| m.emission = Some(0), "emission-map"),
        (|m| m.occlusion = Some(0), "occlusion-map"),
        (|m| m.alpha_mask = Some(0), "alpha-mask"),
    ];
    for (change, want) in cases {
        assert_eq!(called_for(&with_maps(change)), format!("{base},{want}"));
    }
    // What is metal in places reflects there.
    assert_eq!(
        called_for(&with_maps(|m| m.metalness = Some(0))),
        "diffuse-lobe,specular-lobe,rough-diffuse,emission,metalness-map"
    );
}

#[test]
fn a_map_that_cannot_change_anything_is_not_called_for() {
    let unseen = with_material(|m| {
        m.albedo = [0.0; 3];
        m.metalness = 0.0;
        m.normal_scale = 0.0;
        m.alpha_cutoff = 0.0;
        m.maps = Maps {
            base_color: Some(0),
            roughness: Some(0),
            metalness: Some(0),
            normal: Some(0),
            emission: Some(0),
            alpha_mask: Some(0),
            ..Maps::default()
        };
    });
    assert_eq!(called_for(&unseen), "");
}

#[test]
fn callers_are_told_by_name_in_the_scenes_order() {
    let mut scene = plain();
    scene.materials.push(Material {
        name: "glow".into(),
        emission: [1.0; 3],
        ..matte()
    });
    let callers = |name: &str| {
        let effect = ALL.iter().find(|effect| effect.name == name);
        effect
            .map(|effect| effect.callers(&scene))
            .unwrap_or_default()
    };
    assert_eq!(callers("emission"), [Caller::Material("glow".into())]);
    let both = ["stuff", "glow"].map(|name| Caller::Material(name.into()));
    assert_eq!(callers("diffuse-lobe"), both);
    assert_eq!(callers("spot-light"), []);
    assert_eq!(both[0].to_string(), "material \"stuff\"");
}

#[test]
fn sets_are_read_by_name_and_the_nearest_name_is_told() {
    let names: Vec<_> = ALL.iter().map(|effect| effect.name).collect();
    assert_eq!(EffectSet::of_names(names), Ok(EffectSet::ALL));
    assert_eq!(EffectSet::of_names([]), Ok(EffectSet::NONE));
    let error = |name: &str| EffectSet::of_names([name]).unwrap_err().to_string();
    assert!(error("spotlight").contains("'spot-light'"));
    let far = error("caustics");
    assert!(
        far.contains("diffuse-lobe") && far.contains("shadow"),
        "{far}"
    );
}

#[test]
fn the_default_is_what_the_scene_calls_for() {
    let effects = Effects::default();
    assert_eq!(
        (effects.allowed, effects.build),
        (EffectSet::ALL, Build::Scene)
    );
    assert_eq!(effects.idle, EffectSet::NONE);
}
