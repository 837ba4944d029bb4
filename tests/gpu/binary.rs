//! Does the program end with the right code, say why, and leave no half-written file?

use std::path::Path;
use std::process::{Command, Output};

use glam::Vec3;
use serde_json::Value;

const UMBER: &str = env!("CARGO_BIN_EXE_umber");

fn umber(folder: &Path, arguments: &[&str]) -> std::io::Result<Output> {
    Command::new(UMBER)
        .args(arguments)
        .current_dir(folder)
        .output()
}

fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// A square that fills the picture.
const SQUARE: &str = r#"
[camera]
position = [0, 5, 0]
target = [0, 0, 0]
up = [0, 0, -1]
projection = "orthographic"
height = 0.5
exposure_ev100 = 0

[light.lamp]
kind = "directional"
direction = [-0.3, -1, 0.2]
illuminance = 3.0

[model.square]
shape = "plane"
material = "plaster"
"#;

fn folder_with_scene() -> std::io::Result<tempfile::TempDir> {
    let folder = tempfile::tempdir()?;
    std::fs::write(folder.path().join("scene.toml"), SQUARE)?;
    Ok(folder)
}

fn names(folder: &Path) -> std::io::Result<Vec<String>> {
    let mut names: Vec<_> = std::fs::read_dir(folder)?
        .map(|entry| entry.map(|e| e.file_name().to_string_lossy().into_owned()))
        .collect::<Result<_, _>>()?;
    names.sort();
    Ok(names)
}

#[test]
fn a_render_writes_its_picture_and_the_whole_report() -> Result<(), Box<dyn std::error::Error>> {
    let folder = folder_with_scene()?;
    let arguments = [
        "render",
        "scene.toml",
        "--size",
        "40x30",
        "--json",
        "--quiet",
        "--validation",
    ];
    let output = umber(folder.path(), &arguments)?;
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert_eq!(stderr(&output), "", "quiet is quiet");
    let report: Value = serde_json::from_slice(&output.stdout)?;
    assert_eq!(report["schema"], "umber.render/1");
    for key in ["name", "type", "driver", "driver_version", "api"] {
        assert!(report["device"][key].is_string(), "device.{key}");
    }
    for key in ["triangles", "materials", "lights"] {
        assert!(report["scene"][key].as_u64() > Some(0), "scene.{key}");
    }
    let pass = &report["frame"]["passes"][0];
    assert_eq!(pass["name"], "shading");
    for (key, count) in [
        ("draws", 1),
        ("pipeline_binds", 1),
        ("descriptor_set_binds", 1),
    ] {
        assert_eq!(pass[key], count, "{key}");
    }
    assert_eq!(report["frame"]["pipelines_created"], 1);
    for key in ["first_draw_ms", "record_ms", "submit_to_idle_ms", "gpu_ms"] {
        assert!(report["frame"][key].as_f64() > Some(0.0), "frame.{key}");
    }
    assert_eq!(report["image"]["path"], "scene.png");
    assert_eq!(report["image"]["nan_pixels"], 0);
    assert_eq!(report["validation_messages"], 0);
    let picture = image::open(folder.path().join("scene.png"))?.to_rgb8();
    assert_eq!(picture.dimensions(), (40, 30));
    assert_eq!(names(folder.path())?, ["scene.png", "scene.toml"]);
    Ok(())
}

#[test]
fn each_format_holds_the_picture_in_its_own_way() -> Result<(), Box<dyn std::error::Error>> {
    let folder = folder_with_scene()?;
    let mut pictures = Vec::new();
    for name in ["a.exr", "a.hdr"] {
        let arguments = [
            "render",
            "scene.toml",
            "--size",
            "16x16",
            "--samples",
            "1",
            "-o",
            name,
        ];
        let output = umber(folder.path(), &arguments)?;
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        pictures.push(image::open(folder.path().join(name))?.to_rgb32f());
    }
    // Both are linear; RGBE keeps 8 bits of mantissa.
    for (exr, hdr) in pictures[0].pixels().zip(pictures[1].pixels()) {
        for (exr, hdr) in exr.0.into_iter().zip(hdr.0) {
            assert!(
                (exr - hdr).abs() <= exr.abs() / 100.0 + 1e-3,
                "{exr} and {hdr}"
            );
        }
    }
    let arguments = [
        "render",
        "scene.toml",
        "--size",
        "16x16",
        "--quiet",
        "-o",
        "-",
    ];
    let output = umber(folder.path(), &arguments)?;
    let picture = image::load_from_memory_with_format(&output.stdout, image::ImageFormat::Png)?;
    assert_eq!((picture.width(), picture.height()), (16, 16));
    Ok(())
}

/// 8 x 8 squares across `line`, whose normals are `line` but for the last bits of each component.
fn squares_across(line: Vec3) -> String {
    let (right, up) = line.any_orthonormal_pair();
    let mut text = String::new();
    for i in 0..64 {
        let middle = right * ((i % 8) as f32 - 3.5) + up * ((i / 8) as f32 - 3.5);
        for corner in [-right - up, right - up, right + up, up - right] {
            let [x, y, z] = (middle + corner * 0.5).to_array();
            text += &format!("v {x} {y} {z}\n");
        }
        let nudge = |bits: i32| f32::EPSILON * 0.5 * (i >> bits & 3) as f32;
        let normal = line + Vec3::new(nudge(0), nudge(2), nudge(4));
        text += &format!("vn {} {} {}\n", normal.x, normal.y, normal.z);
        text += "f -4//-1 -3//-1 -2//-1 -1//-1\n";
    }
    text
}

#[test]
fn a_picture_with_nan_is_written_and_ends_with_5() -> Result<(), Box<dyn std::error::Error>> {
    let folder = tempfile::tempdir()?;
    let line = Vec3::new(1.7, 2.9, 4.3).normalize();
    std::fs::write(folder.path().join("squares.obj"), squares_across(line))?;
    let scene = format!(
        "[camera]\nposition = {0:?}\ntarget = [0, 0, 0]\nprojection = \"orthographic\"\nheight = 8\n\
         [light.lamp]\nkind = \"directional\"\ndirection = {1:?}\nilluminance = 1\n\
         [model.squares]\nfile = \"squares.obj\"\nmaterial = \"gold\"\n",
        (line * 8.0).to_array(),
        (-line).to_array()
    );
    std::fs::write(folder.path().join("scene.toml"), scene)?;
    // Mirrors seen at their peak: the listing divides by roughness 0.
    let arguments = [
        "render",
        "scene.toml",
        "--size",
        "64x64",
        "--samples",
        "1",
        "--lighting",
        "slides",
        "--set",
        "material.gold.roughness=0",
    ];
    let output = umber(folder.path(), &arguments)?;
    assert_eq!(output.status.code(), Some(5), "{}", stderr(&output));
    assert!(stderr(&output).contains("column"), "{}", stderr(&output));
    assert!(names(folder.path())?.contains(&"scene.png".to_owned()));
    Ok(())
}

#[test]
fn what_the_command_line_asks_wrongly_ends_with_2() -> std::io::Result<()> {
    let folder = folder_with_scene()?;
    let cases: [(&[&str], &str); 9] = [
        (&["--size", "0x10"], "at least one pixel"),
        (&["--size", "16"], "WIDTHxHEIGHT"),
        (&["--size", "1000000x8"], "at most"),
        (&["--samples", "3"], "1, 2, 4 or 8"),
        (&["--lighting", "toon"], "corrected"),
        (&["--terms", "glitter"], "specular"),
        (&["-o", "picture.bmp"], "png"),
        (&["-o", "-", "--json"], "stdout"),
        (&["--set", "material.glod.roughness=1"], "gold"),
    ];
    for (arguments, expected) in cases {
        let all = [&["render", "scene.toml"], arguments].concat();
        let output = umber(folder.path(), &all)?;
        assert_eq!(
            output.status.code(),
            Some(2),
            "{arguments:?}: {}",
            stderr(&output)
        );
        let text = stderr(&output);
        assert!(text.contains(expected), "{arguments:?}: {text}");
        assert!(!text.contains("panicked"), "{text}");
        assert_eq!(names(folder.path())?, ["scene.toml"], "{arguments:?}");
    }
    Ok(())
}

#[test]
fn a_missing_device_driver_or_loader_ends_with_3() -> std::io::Result<()> {
    let folder = folder_with_scene()?;
    let output = umber(
        folder.path(),
        &["render", "scene.toml", "--device", "voodoo"],
    )?;
    assert_eq!(output.status.code(), Some(3), "{}", stderr(&output));
    assert!(stderr(&output).contains("voodoo"));

    let without_driver = |arguments: &[&str]| {
        Command::new(UMBER)
            .args(arguments)
            .current_dir(folder.path())
            .env("VK_DRIVER_FILES", "/nowhere.json")
            .env("VK_ICD_FILENAMES", "/nowhere.json")
            .output()
    };
    for arguments in [&["render", "scene.toml"][..], &["devices"], &["doctor"]] {
        let output = without_driver(arguments)?;
        assert_eq!(output.status.code(), Some(3), "{arguments:?}");
        let said = stderr(&output) + &String::from_utf8_lossy(&output.stdout);
        assert!(
            said.contains("mesa-vulkan-drivers"),
            "{arguments:?}: {said}"
        );
    }

    // A library of the loader's name that is none stands in for a system without one.
    std::fs::write(folder.path().join("libvulkan.so.1"), "not a library")?;
    let output = Command::new(UMBER)
        .args(["render", "scene.toml"])
        .current_dir(folder.path())
        .env("LD_LIBRARY_PATH", folder.path())
        .output()?;
    assert_eq!(output.status.code(), Some(3), "{}", stderr(&output));
    assert!(
        stderr(&output).contains("no Vulkan loader"),
        "{}",
        stderr(&output)
    );
    assert_eq!(names(folder.path())?, ["libvulkan.so.1", "scene.toml"]);
    Ok(())
}

#[test]
fn a_file_that_cannot_be_read_or_written_ends_with_6() -> std::io::Result<()> {
    let folder = folder_with_scene()?;
    std::fs::write(folder.path().join("broken.toml"), "[camera\nposition = 1")?;
    std::fs::write(
        folder.path().join("typo.toml"),
        "[camera]\npositoin = [0, 0, 1]",
    )?;
    std::fs::write(
        folder.path().join("absent.toml"),
        "[model.a]\nfile = \"nothing.obj\"",
    )?;
    let cases: [(&[&str], &[&str]); 6] = [
        (&["broken.toml"], &["broken.toml:1"]),
        (&["typo.toml"], &["typo.toml:2", "position"]),
        (&["absent.toml"], &["nothing.obj"]),
        (&["nowhere.toml"], &["nowhere.toml"]),
        (&["scene.toml", "-o", "missing/a.png"], &["missing"]),
        (&["scene.toml", "-o", "/proc/a.png"], &["/proc/a.png"]),
    ];
    for (arguments, expected) in cases {
        let before = names(folder.path())?;
        let all = [&["render"], arguments].concat();
        let output = umber(folder.path(), &all)?;
        let text = stderr(&output);
        assert_eq!(output.status.code(), Some(6), "{arguments:?}: {text}");
        for word in expected {
            assert!(text.contains(word), "{arguments:?}: {text}");
        }
        assert_eq!(names(folder.path())?, before, "{arguments:?}");
    }
    Ok(())
}

#[test]
fn help_version_completions_and_devices_go_to_stdout() -> std::io::Result<()> {
    let folder = tempfile::tempdir()?;
    let cases: [(&[&str], &str); 5] = [
        (&["--help"], "Exit codes"),
        (&["render", "--help"], "--lighting"),
        (&["--version"], "umber"),
        (&["completions", "bash"], "_umber"),
        (&["devices", "--json"], "umber.devices/1"),
    ];
    for (arguments, expected) in cases {
        let output = umber(folder.path(), arguments)?;
        assert_eq!(output.status.code(), Some(0), "{arguments:?}");
        let text = String::from_utf8_lossy(&output.stdout);
        assert!(text.contains(expected), "{arguments:?}: {text}");
    }
    Ok(())
}
