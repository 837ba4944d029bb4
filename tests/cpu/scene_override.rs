//! Does `--set` change what it names, nothing else, and only what exists?

use std::fs;

use umber::scene::{self, LightKind, LoadOptions, Projection, Scene};

const SCENE: &str = r#"
[light.sun]
kind = "directional"
direction = [0, -1, 0]
illuminance = 1000
[material.mine]
like = "wood"
[model.ball]
shape = "sphere"
material = "gold"
[model.cube]
shape = "sphere"
material = "mine"
"#;

/// The scene with the given overrides.
fn load(overrides: &[&str]) -> Result<Scene, scene::Error> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("scene.toml");
    fs::write(&path, SCENE).expect("a written file");
    let options = LoadOptions {
        overrides: overrides.iter().map(|&text| text.to_owned()).collect(),
        ..LoadOptions::default()
    };
    scene::load(&path, &options)
}

#[test]
fn one_number_changes_and_nothing_else() {
    let before = load(&[]).expect("a good scene");
    let after = load(&["material.gold.roughness=0.3"]).expect("a good scene");
    assert_ne!(before.materials[0].roughness, 0.3);
    assert_eq!(after.materials[0].roughness, 0.3);
    assert_eq!(after.materials[0].f0, before.materials[0].f0);
    assert_eq!(after.materials[1], before.materials[1]);
    assert_eq!(after.camera, before.camera);
    assert_eq!(after.lights, before.lights);
}

#[test]
fn every_table_can_be_reached() {
    let scene = load(&[
        "camera.exposure_ev100 = 9",
        "camera.projection = \"orthographic\"",
        "camera.height = 4",
        "ambient.sky = [1, 2, 3]",
        "light.sun.illuminance = 5",
        "light.sun.color = [1, 0.5, 0]",
        "material.mine.opacity = 0.5",
        "material.wood.roughness = 0.11",
        "model.ball.position = [9, 0, 0]",
        "model.ball.material = \"copper\"",
        "model.ball.scale = 3",
    ])
    .expect("a good scene");
    assert_eq!(scene.camera.exposure_ev100, 9.0);
    let wanted = Projection::Orthographic { height: 4.0 };
    assert_eq!(scene.camera.projection, wanted);
    assert_eq!(scene.ambient.sky, [1.0, 2.0, 3.0]);
    let LightKind::Directional { illuminance, .. } = scene.lights[0].kind else {
        panic!("{:?}", scene.lights[0]);
    };
    assert_eq!(illuminance, 5.0);
    assert_eq!(scene.lights[0].color, [1.0, 0.5, 0.0]);
    assert_eq!(scene.materials[0].name, "copper");
    assert_eq!(scene.materials[1].opacity, 0.5);
    assert_eq!(scene.materials[1].roughness, 0.11, "'mine' is like wood");
    assert_eq!(scene.objects[0].transform.translation.x, 9.0);
    assert_eq!(scene.objects[0].transform.matrix3.x_axis.x, 3.0);
}

#[test]
fn the_last_of_two_counts() {
    let scene = load(&["material.gold.roughness=0.1", "material.gold.roughness=0.2"]);
    assert_eq!(scene.expect("a good scene").materials[0].roughness, 0.2);
}

#[test]
fn what_does_not_exist_is_refused_as_wrong_usage() {
    for (text, wanted) in [
        (
            "material.golf.roughness=0.3",
            "unknown material 'golf'; the nearest known one is 'gold'",
        ),
        (
            "material.gold.roughnes=0.3",
            "unknown key 'roughnes'; the nearest known one is 'roughness'",
        ),
        (
            "matereal.gold.roughness=0.3",
            "unknown key 'matereal'; the nearest known one is 'material'",
        ),
        (
            "light.sum.illuminance=1",
            "unknown light 'sum'; the nearest known one is 'sun'",
        ),
        (
            "model.bal.scale=1",
            "unknown model 'bal'; the nearest known one is 'ball'",
        ),
        (
            "camera.fov=1",
            "unknown key 'fov'; known are 'position', 'target', 'up', 'projection', \
             'vertical_fov_degrees', 'height', 'exposure_ev100'",
        ),
        (
            "material.xyzzy.roughness=1",
            "unknown material 'xyzzy'; known are 'mine', 'glass', 'wood', ",
        ),
        (
            "light.sun.intensity=1",
            "light.sun.intensity: a directional light has no intensity",
        ),
        (
            "material.gold.roughness=1.5",
            "material.gold.roughness = 1.5: must be at least 0 and at most 1",
        ),
        ("material.gold.roughness=\"a\"", "invalid type"),
        ("material.gold.roughness", "write KEY=VALUE"),
        ("model.ball.material=copper", "with text in quotes"),
        (
            "model.ball.material=\"coper\"",
            "unknown material 'coper'; the nearest known one is 'copper'",
        ),
        ("", "changes nothing: write KEY=VALUE"),
        ("a=1\nb=2", "must be one line"),
        ("[camera]", "changes nothing: write KEY=VALUE"),
        ("light.sun={}", "changes nothing: write KEY=VALUE"),
    ] {
        let error = load(&[text]).expect_err("an override that is refused");
        assert_eq!(error.exit_code(), 2, "{error}");
        let error = error.to_string();
        assert!(error.starts_with(&format!("--set '{text}': ")), "{error}");
        assert!(error.contains(wanted), "{error}\n  wanted {wanted}");
    }
}

#[test]
fn an_obj_alone_has_camera_lights_and_materials_to_change() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("tri.obj");
    fs::write(
        &path,
        "mtllib tri.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl Red\nf 1 2 3\n",
    )
    .expect("a written file");
    fs::write(
        folder.path().join("tri.mtl"),
        "newmtl Red\nKd 1 0 0\nPr 0.5\n",
    )
    .expect("written");
    let load = |overrides: &[&str]| {
        let options = LoadOptions {
            overrides: overrides.iter().map(|&text| text.to_owned()).collect(),
            ..LoadOptions::default()
        };
        scene::load(&path, &options)
    };
    let scene = load(&[
        "material.Red.roughness=0.125",
        "camera.exposure_ev100=3",
        "light.key.illuminance=7",
        "ambient.ground=2",
    ])
    .expect("a good scene");
    assert_eq!(scene.materials[0].name, "Red");
    assert_eq!(scene.materials[0].albedo, [1.0, 0.0, 0.0]);
    assert_eq!(scene.materials[0].roughness, 0.125);
    assert_eq!(scene.camera.exposure_ev100, 3.0);
    assert_eq!(scene.ambient.ground, [2.0; 3]);
    let LightKind::Directional { illuminance, .. } = scene.lights[0].kind else {
        panic!("{:?}", scene.lights[0]);
    };
    assert_eq!((scene.lights[0].name.as_str(), illuminance), ("key", 7.0));

    let error = load(&["material.Read.roughness=0.5"]).expect_err("no such material");
    assert_eq!(error.exit_code(), 2);
    let error = error.to_string();
    assert!(
        error.contains("unknown material 'Read'; the nearest known one is 'Red'"),
        "{error}"
    );
    let error = load(&["camera.target=[1e20,0,0]"])
        .expect_err("too far")
        .to_string();
    assert!(error.starts_with("--set 'camera.target"), "{error}");
}
