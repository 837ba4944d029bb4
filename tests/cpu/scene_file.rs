//! Does a scene file become the scene that it describes, and does each mistake get its own message?

use std::fs;
use std::path::PathBuf;

use proptest::prelude::*;
use tempfile::TempDir;
use umber::scene::{self, LightKind, LoadOptions, Projection, Scene};

use crate::mutation;

#[path = "scene_file/limits.rs"]
mod limits;

/// A folder that holds `scene.toml` with the given text.
fn folder(text: &str) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("scene.toml");
    fs::write(&path, text).expect("a written file");
    (folder, path)
}

fn load(text: &str) -> Result<Scene, scene::Error> {
    let (_folder, path) = folder(text);
    scene::load(&path, &LoadOptions::default())
}

/// The message for `text`, from the file's name on; the exit code must be 6.
fn message(text: &str) -> String {
    let error = load(text).map(drop).expect_err("a scene that is wrong");
    assert_eq!(error.exit_code(), 6, "{error}");
    let message = error.to_string();
    match message.find("scene.toml") {
        Some(start) => message[start..].to_owned(),
        None => message,
    }
}

const BALL: &str = "[model.ball]\nshape = \"sphere\"\n";

const EVERY_TABLE: &str = r#"
[camera]
position = [1, 2, 3]
target = [0.0, 0.5, 0.0]
up = [0, 0, 1]
vertical_fov_degrees = 50
exposure_ev100 = 12.5
[ambient]
sky = [1.0, 2.0, 3.0]
ground = 4
[light.sun]
kind = "directional"
direction = [0, -2, 0]
illuminance = 1e5
[light.bulb]
kind = "point"
position = [0, 3, 0]
intensity = 800
color = [1.0, 0.5, 0.25]
[light.lamp]
kind = "spot"
position = [0, 4, 0]
target = [0, 0, 3]
intensity = 1000
radius = 0.1
inner_degrees = 10
outer_degrees = 30
[material.mine]
albedo = [0.1, 0.2, 0.3]
roughness = 0.7
[model.ball]
shape = "sphere"
material = "mine"
position = [5, 0, 0]
scale = 2
"#;

#[test]
fn every_table_reaches_the_scene() {
    let scene = load(EVERY_TABLE).expect("a good scene");
    assert_eq!(scene.camera.position.to_array(), [1.0, 2.0, 3.0]);
    assert_eq!(scene.camera.up.to_array(), [0.0, 0.0, 1.0]);
    assert_eq!(scene.camera.exposure_ev100, 12.5);
    let fov = Projection::Perspective {
        vertical_fov_degrees: 50.0,
    };
    assert_eq!(scene.camera.projection, fov);
    assert_eq!(scene.ambient.sky, [1.0, 2.0, 3.0]);
    assert_eq!(scene.ambient.ground, [4.0; 3]);
    let names: Vec<&str> = scene.lights.iter().map(|l| l.name.as_str()).collect();
    assert_eq!(names, ["sun", "bulb", "lamp"]);
    let LightKind::Directional {
        direction,
        angular_diameter_degrees,
        ..
    } = scene.lights[0].kind
    else {
        panic!("{:?}", scene.lights[0]);
    };
    assert_eq!(direction.to_array(), [0.0, -1.0, 0.0], "of unit length");
    assert_eq!(angular_diameter_degrees, 0.53, "the sun's");
    let LightKind::Point { radius, .. } = scene.lights[1].kind else {
        panic!("{:?}", scene.lights[1]);
    };
    assert_eq!(radius, 0.05);
    assert_eq!(scene.lights[1].color, [1.0, 0.5, 0.25]);
    let LightKind::Spot { direction, .. } = scene.lights[2].kind else {
        panic!("{:?}", scene.lights[2]);
    };
    assert!((direction - glam::Vec3::new(0.0, -0.8, 0.6)).length() < 1e-6);
    assert_eq!(scene.materials.len(), 1, "only materials in use");
    assert_eq!(scene.materials[0].albedo, [0.1, 0.2, 0.3]);
    assert_eq!(scene.materials[0].roughness, 0.7);
    assert_eq!(scene.materials[0].f0, [0.04; 3], "the default");
    assert_eq!(scene.objects.len(), 1);
    let bounds = scene.bounds();
    assert!((bounds.center() - glam::Vec3::new(5.0, 0.0, 0.0)).length() < 1e-5);
    assert!((bounds.max.x - 7.0).abs() < 1e-2, "scaled by two");
    assert_eq!(
        scene.triangle_count(),
        scene.meshes[scene.objects[0].mesh].triangle_count()
    );
}

#[test]
fn rotation_turns_about_fixed_x_then_y_then_z() {
    let scene = load(&format!("{BALL}rotation_degrees = [90, 90, 0]\n")).expect("a good scene");
    // x turns y into z, then y turns z into x.
    let turned = scene.objects[0].transform.transform_vector3(glam::Vec3::Y);
    assert!((turned - glam::Vec3::X).length() < 1e-6, "{turned}");
}

#[test]
fn a_mesh_that_many_models_use_is_loaded_once() {
    let mut text = String::new();
    for number in 0..10 {
        text.push_str(&format!(
            "[model.ball{number}]\nshape = \"sphere\"\nmaterial = \"gold\"\n"
        ));
    }
    let scene = load(&text).expect("a good scene");
    assert_eq!(scene.objects.len(), 10);
    assert_eq!(scene.meshes.len(), 1);
    assert_eq!(scene.materials.len(), 1);
    assert_eq!(
        scene.triangle_count(),
        10 * scene.meshes[0].triangle_count(),
        "counted over objects"
    );
}

#[test]
fn a_scene_without_camera_and_lights_is_framed_and_lit() {
    let scene = load(BALL).expect("a good scene");
    assert_eq!(scene.lights.len(), 3);
    let Projection::Perspective {
        vertical_fov_degrees,
    } = scene.camera.projection
    else {
        panic!("{:?}", scene.camera.projection);
    };
    // The sphere around the bounds fits the picture's height.
    let distance = scene.camera.position.distance(scene.camera.target);
    let half = (vertical_fov_degrees / 2.0).to_radians();
    assert!(distance * half.sin() >= scene.bounds().radius());
    assert!(distance * half.sin() <= 1.1 * scene.bounds().radius());
    // White that faces the key light, lit by key and fill and ambient, stays below 1.0.
    let white = 1.2 * scene.camera.exposure_ev100.exp2();
    let mut luminance = scene.ambient.sky[1];
    for light in &scene.lights[..2] {
        let LightKind::Directional { illuminance, .. } = light.kind else {
            panic!("{light:?}");
        };
        luminance += illuminance / std::f32::consts::PI;
    }
    let shown = 0.8 * luminance / white;
    assert!(
        (0.5..1.0).contains(&shown),
        "albedo 0.8 is shown as {shown}"
    );

    let dark = load(&format!("{BALL}[ambient]\nsky = 1.0\n")).expect("a good scene");
    assert!(
        dark.lights.is_empty(),
        "a scene that says its light keeps it"
    );
}

#[test]
fn an_orthographic_camera_has_a_height() {
    let text = format!("{BALL}[camera]\nprojection = \"orthographic\"\nheight = 3.0\n");
    let scene = load(&text).expect("a good scene");
    let wanted = Projection::Orthographic { height: 3.0 };
    assert_eq!(scene.camera.projection, wanted);
}

#[test]
fn mistakes_in_the_text_have_line_and_column() {
    for (text, wanted) in [
        ("[camera]\nposition = [1, 2\n", "scene.toml:"),
        ("a = = 1\n", "scene.toml:1:5"),
        (
            "[camera]\npositoin = [1, 2, 3]\n",
            "scene.toml:2:1: unknown key 'positoin'; the nearest known one is 'position'",
        ),
        (
            "[lihgt.sun]\n",
            "scene.toml:1:2: unknown key 'lihgt'; the nearest known one is 'light'",
        ),
        (
            "[material.gold]\nroughnes = 0.3\n",
            "scene.toml:2:1: unknown key 'roughnes'; the nearest known one is 'roughness'",
        ),
        (
            "[light.sun]\nkind = \"directionel\"\n",
            "scene.toml:2:8: unknown value 'directionel'; the nearest known one is 'directional'",
        ),
        (
            "[model.a]\nscale = [1, 2]\n",
            "scene.toml:2:9: invalid length 2, expected a number or an array of three numbers",
        ),
        (
            "[camera]\nposition = \"here\"\n",
            "scene.toml:2:12: invalid type",
        ),
    ] {
        let found = message(text);
        assert!(found.starts_with(wanted), "{found}\n  wanted {wanted}");
    }
}

/// Each text follows `BALL`; the message must start with the place and the words.
fn check_messages(cases: &[(&str, &str, &str)]) {
    for (text, place, wanted) in cases {
        let found = message(&format!("{BALL}{text}"));
        let wanted = format!("scene.toml:{place}: {wanted}");
        assert!(found.starts_with(&wanted), "{found}\n  wanted {wanted}");
    }
}

#[test]
fn numbers_out_of_range_name_key_value_range_and_place() {
    check_messages(&[
        (
            "[material.m]\nroughness = 1.5\n",
            "4:13",
            "material.m.roughness = 1.5: must be at least 0 and at most 1",
        ),
        (
            "[material.m]\nalbedo = [0.5, nan, 0.5]\n",
            "4:10",
            "material.m.albedo = NaN: must be",
        ),
        (
            "[material.m]\nf0 = -0.1\n",
            "4:6",
            "material.m.f0 = -0.1: must be",
        ),
        (
            "[material.m]\nopacity = 2\n",
            "4:11",
            "material.m.opacity = 2: must be",
        ),
        (
            "[material.m]\nemission = [0, inf, 0]\n",
            "4:12",
            "material.m.emission = inf: must be",
        ),
        (
            "[camera]\nvertical_fov_degrees = 180\n",
            "4:24",
            "camera.vertical_fov_degrees = 180: must be at least 0.001 and less than 180",
        ),
        (
            "[camera]\nposition = [1, 1, 1]\ntarget = [1, 1, 1]\n",
            "5:10",
            "camera.target equals camera.position",
        ),
        (
            "[camera]\nposition = [0, 5, 0]\ntarget = [0, 0, 0]\nup = [0, 1, 0]\n",
            "6:6",
            "camera.up is zero or parallel to the view",
        ),
        (
            "[model.b]\nshape = \"sphere\"\nscale = [1, 0, 1]\n",
            "5:9",
            "model.b.scale = [1.0, 0.0, 1.0]: no factor may be nearer to 0 than 1e-6",
        ),
        (
            "[model.b]\nshape = \"sphere\"\nscale = inf\n",
            "5:9",
            "model.b.scale = inf: must be",
        ),
        (
            "[model.b]\nshape = \"sphere\"\nposition = [0, 1e13, 0]\n",
            "5:12",
            "model.b.position = 1e13: must be",
        ),
    ]);
}

#[test]
fn mistakes_in_lights_name_key_and_place() {
    let sun = "[light.s]\nkind = \"directional\"\ndirection = [0, -1, 0]\n";
    let spot = "[light.s]\nkind = \"spot\"\nposition = [0, 1, 0]\nintensity = 1\n";
    check_messages(&[
        (
            &format!("{sun}illuminance = -1\n"),
            "6:15",
            "light.s.illuminance = -1: must be at least 0",
        ),
        (sun, "3:1", "light.s.illuminance is missing"),
        (
            &format!("{sun}illuminance = 1\nintensity = 1\n"),
            "7:13",
            "light.s.intensity: a directional light has no intensity",
        ),
        (
            "[light.s]\nkind = \"directional\"\nilluminance = 1\ndirection = [0, 0, 0]\n",
            "6:13",
            "light.s.direction gives no direction",
        ),
        (
            &format!("{spot}direction = [0, -1, 0]\nradius = 0\n"),
            "8:10",
            "light.s.radius = 0: must be more than 0",
        ),
        (
            &format!("{spot}direction = [0, -1, 0]\nouter_degrees = 90\n"),
            "8:17",
            "light.s.outer_degrees = 90: must be at least 0.5 and less than 90",
        ),
        (
            &format!("{spot}direction = [0, -1, 0]\ninner_degrees = 30\nouter_degrees = 30\n"),
            "8:17",
            "light.s.inner_degrees = 30: must be at least 0 and less than 30",
        ),
        (
            &format!("{spot}direction = [0, -1, 0]\nouter_degrees = 0.08\n"),
            "8:17",
            "light.s.outer_degrees = 0.08: must be at least 0.5 and less than 90",
        ),
        (
            &format!("{spot}direction = [0, -1, 0]\ninner_degrees = 29.9999\nouter_degrees = 30\n"),
            "8:17",
            "light.s.inner_degrees = 29.9999 is too near to outer_degrees = 30",
        ),
        (
            &format!("{spot}direction = [0, -1, 0]\ntarget = [0, 0, 0]\n"),
            "8:10",
            "light.s: give target or direction, not both",
        ),
    ]);
}

#[test]
fn names_that_do_not_exist_get_the_nearest() {
    for (text, wanted) in [
        (
            "[model.a]\nshape = \"shpere\"\n",
            "scene.toml:2:9: unknown shape 'shpere'; the nearest known one is 'sphere'",
        ),
        (
            "[model.a]\nshape = \"sphere\"\nmaterial = \"godl\"\n",
            "scene.toml:3:12: model.a.material: unknown material 'godl'; the nearest known one is 'gold'",
        ),
        (
            "[model.a]\nshape = \"sphere\"\nmaterials = { bal = \"gold\" }\n",
            "scene.toml:3:21: model.a: unknown part 'bal'",
        ),
        (
            "[material.a]\nlike = \"plastik\"\n[model.a]\nshape = \"sphere\"\nmaterial = \"a\"\n",
            "scene.toml:2:8: unknown material 'plastik'; the nearest known one is 'plastic'",
        ),
        (
            "[material.a]\nlike = \"b\"\n[material.b]\nlike = \"a\"\n[model.a]\nshape = \"sphere\"\n",
            "scene.toml:4:8: material.b.like = 'a' leads back to itself",
        ),
        (
            "[model.a]\n",
            "scene.toml:1:1: model.a needs a shape or a file",
        ),
        (
            "[model.a]\nshape = \"sphere\"\nfile = \"a.obj\"\n",
            "scene.toml:3:8: model.a: give shape or file, not both",
        ),
        (
            "[camera]\n",
            "scene.toml: has no [model.NAME]: there is nothing to draw",
        ),
        (
            "",
            "scene.toml: has no [model.NAME]: there is nothing to draw",
        ),
    ] {
        let found = message(text);
        assert!(found.starts_with(wanted), "{found}\n  wanted {wanted}");
    }
}

#[test]
fn too_many_lights_are_refused() {
    let mut text = BALL.to_owned();
    for number in 0..257 {
        text.push_str(&format!(
            "[light.l{number}]\nkind = \"point\"\nposition = [0, 2, 0]\nintensity = 1\n"
        ));
    }
    let found = message(&text);
    assert!(
        found.contains("257 lights: at most 256 are possible"),
        "{found}"
    );
    let (allowed, _) = text.split_at(text.find("[light.l256]").expect("the last light"));
    assert_eq!(load(allowed).expect("a good scene").lights.len(), 256);
}

#[test]
fn files_outside_the_folder_are_refused() {
    let (folder, path) = folder("");
    let outside = tempfile::tempdir().expect("a temporary folder");
    let secret = outside.path().join("secret.obj");
    fs::write(&secret, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").expect("a written file");
    let scene = |file: &str| {
        fs::write(&path, format!("[model.a]\nfile = '{file}'\n")).expect("a written file");
        scene::load(&path, &LoadOptions::default())
    };
    let absolute = secret.display().to_string();
    for (file, wanted) in [
        (absolute.as_str(), "leads out of the folder"),
        ("../secret.obj", "leads out of the folder"),
        ("inner/../a.obj", "leads out of the folder"),
        ("", "the name is empty"),
        ("absent.obj", "is missing: no such file"),
        ("scene.toml", "is not an .obj file"),
    ] {
        let error = scene(file).expect_err("a file that is refused");
        assert_eq!(error.exit_code(), 6);
        let error = error.to_string();
        assert!(error.contains("scene.toml:2:8: model.a.file"), "{error}");
        assert!(error.contains(wanted), "{error}");
    }
    #[cfg(unix)]
    {
        let link = folder.path().join("link.obj");
        std::os::unix::fs::symlink(&secret, &link).expect("a link");
        let error = scene("link.obj")
            .expect_err("a link that leads out")
            .to_string();
        assert!(
            error.contains("is a link that leads out of the folder"),
            "{error}"
        );
    }
    fs::copy(&secret, folder.path().join("inside.obj")).expect("a copied file");
    assert_eq!(
        scene("inside.obj").expect("a good scene").triangle_count(),
        1
    );
}

#[test]
fn the_path_itself_may_be_wrong() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let latin = folder.path().join("latin.toml");
    fs::write(&latin, b"[camera]\n# caf\xe9\n").expect("a written file");
    fs::create_dir(folder.path().join("folder.toml")).expect("a folder");
    for (name, wanted) in [
        ("absent.toml", "there is no such file"),
        ("absent.obj", "there is no such file"),
        ("folder.toml", "is a folder"),
        (
            "scene.json",
            "is neither a scene (.toml) nor a model (.obj)",
        ),
        ("scene", "is neither a scene (.toml) nor a model (.obj)"),
        ("latin.toml", "latin.toml:2:6: is not UTF-8 text"),
    ] {
        let path = folder.path().join(name);
        let error = scene::load(&path, &LoadOptions::default()).expect_err("a bad path");
        assert_eq!(error.exit_code(), 6);
        let error = error.to_string();
        assert!(error.contains(wanted) && error.contains(name), "{error}");
    }
}

#[test]
fn the_roughness_scene_is_the_slides_row() {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("scenes/roughness.toml");
    let scene = scene::load(&path, &LoadOptions::default()).expect("a good scene");
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
    assert_eq!(scene.objects.len(), 22);
    for kind in ["metal", "plaster"] {
        let mut row: Vec<_> = scene
            .objects
            .iter()
            .filter(|object| object.name.starts_with(kind))
            .map(|object| {
                let x = object.transform.translation.x;
                (x, scene.materials[object.material].roughness)
            })
            .collect();
        row.sort_by(|a, b| a.0.total_cmp(&b.0));
        let roughness: Vec<f32> = row.iter().map(|(_, roughness)| *roughness).collect();
        let wanted: Vec<f32> = (0..=10_u8).map(|i| f32::from(i) / 10.0).collect();
        assert_eq!(roughness, wanted, "{kind}");
    }
    // Everything lies inside the picture at 16:9.
    let Projection::Perspective {
        vertical_fov_degrees,
    } = scene.camera.projection
    else {
        panic!("{:?}", scene.camera.projection);
    };
    let up = (vertical_fov_degrees / 2.0).to_radians().tan();
    for corner in scene.bounds().corners() {
        let away = scene.camera.position.z - corner.z;
        assert!(corner.y.abs() / away < up);
        assert!(corner.x.abs() / away < up * 16.0 / 9.0);
    }
}

/// A scene that uses every table and key.
const RICH: &str = r#"
[camera]
position = [1, 2, 3]
projection = "orthographic"
height = 3.0
[ambient]
sky = [1.0, 2.0, 3.0]
[light.lamp]
kind = "spot"
position = [0, 4, 0]
target = [0, 0, 3]
intensity = 1000
[material.mine]
like = "gold"
roughness = 0.7
[model.ball]
shape = "sphere"
material = "mine"
materials = { sphere = "gold" }
scale = [1, 2, 3]
"#;

proptest! {
    #![proptest_config(mutation::cases(400))]

    /// Whatever happens to a scene's text, there is a scene or a message.
    #[test]
    fn mutated_text_never_panics(bytes in mutation::mutated(RICH, b"[]{}=.\"'-e0")) {
        let (_folder, path) = folder("");
        fs::write(&path, &bytes).expect("a written file");
        if let Err(error) = scene::load(&path, &LoadOptions::default()) {
            prop_assert!(error.to_string().contains("scene.toml"), "{}", error);
        }
    }
}

#[test]
fn deep_nesting_is_an_error_and_no_crash() {
    for text in [
        "[".repeat(100_000),
        format!("a = {}", "[".repeat(100_000)),
        "a.".repeat(100_000),
    ] {
        assert!(load(&text).is_err());
    }
}
