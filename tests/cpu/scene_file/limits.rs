//! Where do size, depth and odd names of a scene end, and is each end told?

use std::fs;

use umber::scene::{self, LightKind, LoadOptions, Projection};

use super::{BALL, check_messages, folder, load, message};

/// Materials `m0` to `m{last}`, each like the one before it.
fn chain(last: usize) -> String {
    let links = (1..=last).map(|i| format!("[material.m{i}]\nlike = \"m{}\"\n", i - 1));
    let links: String = links.collect();
    format!("{BALL}material = \"m{last}\"\n[material.m0]\nroughness = 0.25\n{links}")
}

#[test]
fn a_chain_of_materials_has_an_end() {
    let scene = load(&chain(32)).expect("a good scene");
    assert_eq!(scene.materials[0].roughness, 0.25);
    for last in [33, 4000] {
        let found = message(&chain(last));
        let wanted =
            "material.m1.like: from 'm33' to here more than 32 materials are like the next";
        assert!(found.contains(wanted), "{found}\n  wanted {wanted}");
    }
}

#[test]
fn names_in_messages_are_cut_and_have_no_control_characters() {
    let long = "n".repeat(1 << 20);
    for text in [
        format!("[model.a]\nshape = \"{long}\"\n"),
        format!("[model.{long}]\n"),
        format!("{BALL}material = \"{long}\"\n"),
        format!("{BALL}[material.{long}]\nroughness = 2\n"),
        format!("{BALL}[material.{long}]\nlike = \"{long}\"\n"),
        format!("{BALL}[light.{long}]\nkind = \"point\"\nilluminance = 1\n"),
        format!("{BALL}[light.{long}]\nkind = \"point\"\n"),
        format!("{BALL}position = \"{long}\"\n"),
        format!("{long} = 1\n"),
        format!("[model.a]\nfile = \"{long}\"\n"),
    ] {
        let found = load(&text).expect_err("a scene that is wrong").to_string();
        assert!(found.len() < 1000, "{} bytes", found.len());
    }
    for text in [
        "[model.a]\nshape = \"\\u001b[31m\"\n".to_owned(),
        "[model.\"\\u001b[31m\"]\n".to_owned(),
        format!("{BALL}[material.\"\\u001b[31m\"]\nroughness = 2\n"),
        format!("{BALL}position = \"\\u001b[31m\"\n"),
        "\"\\u001b[31m\" = 1\n".to_owned(),
        "[model.a]\nfile = \"\\u001b[31m\"\n".to_owned(),
    ] {
        let found = load(&text).expect_err("a scene that is wrong").to_string();
        assert!(!found.contains(char::is_control), "{found:?}");
    }
}

#[test]
fn a_name_that_is_like_no_other_gets_the_list() {
    check_messages(&[
        (
            "material = \"zzzzzzzz\"\n",
            "3:12",
            "model.ball.material: unknown material 'zzzzzzzz'; known are 'glass', 'wood', ",
        ),
        ("fov = 1\n", "3:1", "unknown key 'fov'; known are 'shape', "),
    ]);
    let many: String = (0..30).map(|i| format!("[material.m{i}]\n")).collect();
    let found = message(&format!("{BALL}material = \"zzzzzzzz\"\n{many}"));
    // Of 30 own and 10 built-in ones, 20 are shown.
    assert!(found.ends_with("'m18', 'm19' and 20 more"), "{found}");
}

#[test]
fn a_scene_file_has_16_mebibytes_at_most() {
    let mut text = format!("{BALL}#");
    text.push_str(&"x".repeat((16 << 20) - text.len()));
    load(&text).expect("a good scene");
    text.push('x');
    let found = message(&text);
    assert!(
        found.starts_with("scene.toml: is larger than 16 MiB"),
        "{found}"
    );
}

#[test]
fn the_parsers_words_are_put_plainly() {
    let deep = format!("{}b = 1\n", "a.".repeat(1000));
    check_messages(&[
        (
            "position = [1, 2, 99999999999999999999]\n",
            "3:19",
            "the integer 99999999999999999999 is too large: write it with a decimal point",
        ),
        (
            "scale = 9223372036854775808\n",
            "3:9",
            "the integer 9223372036854775808 is too large: write it with a decimal point",
        ),
        (
            "position = [9223372036854775808, 0, 0]\n",
            "3:13",
            "the integer is too large: write it with a decimal point",
        ),
        ("shape = 5\n", "3:1", "duplicate key"),
        (
            "material = 5\n",
            "3:12",
            "invalid type: integer `5`, expected a string",
        ),
        (
            &format!("scale = {}\n", "[".repeat(1000)),
            "3:89",
            "tables or arrays nest too deep",
        ),
    ]);
    let found = message(&deep);
    assert_eq!(found, "scene.toml: tables or arrays nest too deep");
}

#[test]
fn an_f0_too_small_to_be_seen_is_0() {
    let text = format!("{BALL}material = \"m\"\n[material.m]\nf0 = [1e-39, 9e-7, 1e-6]\n");
    let scene = load(&text).expect("a good scene");
    assert_eq!(scene.materials[0].f0, [0.0, 0.0, 1e-6]);
}

#[test]
fn the_chosen_view_fits_a_narrow_picture() {
    let (_folder, path) = folder(BALL);
    for aspect in [0.25, 1.0, 4.0] {
        let options = LoadOptions {
            aspect,
            ..LoadOptions::default()
        };
        let scene = scene::load(&path, &options).expect("a good scene");
        let Projection::Perspective {
            vertical_fov_degrees,
        } = scene.camera.projection
        else {
            panic!("{:?}", scene.camera.projection);
        };
        let upright = (vertical_fov_degrees / 2.0).to_radians();
        let across = (upright.tan() * aspect).atan();
        let seen = scene.camera.position.distance(scene.camera.target) * upright.min(across).sin();
        let radius = scene.bounds().radius();
        assert!(seen >= radius && seen <= 1.1 * radius, "{aspect}: {seen}");
    }
    let flat = format!("{BALL}[camera]\nprojection = \"orthographic\"\n");
    fs::write(&path, flat).expect("a written file");
    for aspect in [0.25, 1.0, 4.0, f32::NAN, 0.0, -1.0, f32::INFINITY] {
        let options = LoadOptions {
            aspect,
            ..LoadOptions::default()
        };
        let scene = scene::load(&path, &options).expect("a good scene");
        let Projection::Orthographic { height } = scene.camera.projection else {
            panic!("{:?}", scene.camera.projection);
        };
        let shorter = if aspect == 0.25 {
            height * aspect
        } else {
            height
        };
        let size = 2.0 * scene.bounds().radius();
        assert!(
            shorter >= size && shorter <= 1.1 * size,
            "{aspect}: {shorter}"
        );
    }
}

#[test]
fn a_view_that_f32_cannot_hold_is_refused() {
    check_messages(&[
        (
            "[camera]\nvertical_fov_degrees = 1e-37\n",
            "4:24",
            "camera.vertical_fov_degrees = 1e-37: must be at least 0.001 and less than 180",
        ),
        (
            "[camera]\nprojection = \"orthographic\"\nheight = 1e-39\n",
            "5:10",
            "camera.height = 1e-39: must be at least 1e-6 and at most 1e12",
        ),
        (
            "[camera]\nposition = [0, 0, 0]\ntarget = [0, 0, 1e-30]\n",
            "5:10",
            "camera.target is 1.0e-30 m from camera.position: must be at least 1e-6 m",
        ),
        (
            "[camera]\nposition = [1e9, 0, 0]\ntarget = [1000000100, 0, 0]\n",
            "5:10",
            "camera.target is 1.0e2 m from camera.position, too near for their distance from the origin",
        ),
    ]);
    for text in [
        "vertical_fov_degrees = 0.001\n",
        "projection = \"orthographic\"\nheight = 1e-6\n",
        "position = [0, 0, 0]\ntarget = [0, 0, 1e-6]\n",
        "position = [1e9, 0, 0]\ntarget = [1e9, 0, 1]\n",
    ] {
        load(&format!("{BALL}[camera]\n{text}")).expect("a good scene");
    }
}

#[test]
fn models_that_no_camera_can_be_chosen_for_are_blamed_themselves() {
    let large = "scene.toml:1:2: the models are too large or too far away to be framed";
    let small = "scene.toml:1:2: the models are too small, or too small for their distance";
    for (text, wanted) in [
        ("scale = 1e6\nposition = [1e12, 0, 0]\n", large),
        ("scale = 1e-6\nposition = [1, 0, 0]\n", small),
        ("scale = 0.001\nposition = [1e6, 0, 0]\n", small),
    ] {
        let found = message(&format!("{BALL}{text}"));
        assert!(found.starts_with(wanted), "{found}\n  wanted {wanted}");
    }
    let own = "scale = 1e-6\n[camera]\nposition = [0, 0, 1]\ntarget = [0, 0, 0]\n";
    load(&format!("{BALL}{own}")).expect("a scene with a camera of its own");
}

#[test]
fn a_spot_that_states_no_cone_has_a_theatre_lamps() {
    for (line, wanted) in [("", (15.0, 20.0)), ("outer_degrees = 16\n", (12.0, 16.0))] {
        let spot = "[light.s]\nkind = \"spot\"\nposition = [0, 1, 0]\ndirection = [0, -1, 0]\n\
                    intensity = 1\n";
        let scene = load(&format!("{BALL}{spot}{line}")).expect("a good scene");
        let LightKind::Spot {
            inner_degrees,
            outer_degrees,
            ..
        } = scene.lights[0].kind
        else {
            panic!("a spot");
        };
        assert_eq!((inner_degrees, outer_degrees), wanted);
    }
}
