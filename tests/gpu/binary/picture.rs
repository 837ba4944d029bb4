//! Does the program write the picture that the library renders, and the whole report on it?

use std::path::Path;

use glam::Vec3;
use serde_json::Value;
use umber::gpu::Samples;
use umber::reference::ladders::Mix;
use umber::reference::shade::{Lighting, Terms};
use umber::render::{Picture, PictureFormat, ToneMapping, Variant, encode};
use umber::scene::{self, LoadOptions};

use super::{Place, Tested};
use crate::harness::{whole, with_gpu};

#[test]
fn a_render_writes_its_picture_and_the_whole_report() -> Tested {
    let place = Place::new()?;
    let arguments = ["scene.toml", "--size", "40x30", "--json", "--quiet"];
    let run = place.render(&arguments)?.ends(0, &[]);
    assert_eq!(run.stderr, "", "quiet is quiet");
    let report: Value = serde_json::from_slice(&run.stdout)?;
    assert_eq!(report["schema"], "umber.render/1");
    for key in ["name", "type", "driver", "driver_version", "api", "uuid"] {
        assert!(report["device"][key].is_string(), "device.{key}");
    }
    for (key, count) in [
        ("triangles", 128),
        ("objects", 1),
        ("materials", 1),
        ("lights", 1),
    ] {
        assert_eq!(report["scene"][key], count, "scene.{key}");
    }
    let pass = &report["frame"]["passes"][0];
    assert_eq!(pass["name"], "shading");
    for key in ["draws", "pipeline_binds", "descriptor_set_binds"] {
        assert_eq!(pass[key], 1, "{key}");
    }
    assert_eq!(report["frame"]["pipelines_created"], 1);
    for key in ["first_draw_ms", "record_ms", "submit_to_idle_ms", "gpu_ms"] {
        assert!(report["frame"][key].as_f64() > Some(0.0), "frame.{key}");
    }
    // Both clocks saw the same work; milliseconds, both of them.
    let whole = report["frame"]["submit_to_idle_ms"].as_f64();
    assert!(report["frame"]["gpu_ms"].as_f64() < whole.map(|ms| 2.0 * ms));
    let image = &report["image"];
    assert_eq!(image["path"], "scene.png");
    for (key, count) in [
        ("width", 40),
        ("height", 30),
        ("samples", 4),
        ("nan_pixels", 0),
    ] {
        assert_eq!(image[key], count, "image.{key}");
    }
    assert_eq!(report["validation_messages"], 0);
    assert!(report["start_to_file_ms"].as_f64() > Some(0.0));
    assert_eq!(report["program"]["version"], env!("CARGO_PKG_VERSION"));
    let picture = image::open(place.path("scene.png"))?.to_rgb8();
    assert_eq!(picture.dimensions(), (40, 30));
    assert_eq!(place.names()?, ["scene.png", "scene.toml"]);
    Ok(())
}

#[test]
fn the_report_goes_to_a_file_or_to_stdout_as_asked() -> Tested {
    let place = Place::new()?;
    let small = ["scene.toml", "--size", "8x8"];
    let render = |arguments: &[&str]| place.render(&[&small, arguments].concat());
    let keys = |bytes: &[u8]| -> Result<Vec<String>, Box<dyn std::error::Error>> {
        let report: Value = serde_json::from_slice(bytes)?;
        assert_eq!(report["schema"], "umber.render/1");
        let report = report.as_object().ok_or("an object")?;
        Ok(report.keys().cloned().collect())
    };
    let run = render(&["--json=report.json"])?.ends(0, &[]);
    assert!(run.stdout.is_empty(), "with a file, stdout is left alone");
    assert!(run.stderr.contains("shading: 1 draw,"), "{}", run.stderr);
    let report: Value = serde_json::from_slice(&std::fs::read(place.path("report.json"))?)?;
    let software = run.stderr.contains("a software rasteriser");
    assert_eq!(
        software,
        report["device"]["type"] == "cpu",
        "{}",
        run.stderr
    );
    assert_eq!(place.names()?, ["report.json", "scene.png", "scene.toml"]);
    let to_file = keys(&std::fs::read(place.path("report.json"))?)?;
    assert_eq!(to_file, keys(&render(&["--json"])?.ends(0, &[]).stdout)?);
    assert_eq!(to_file, keys(&render(&["--json=-"])?.ends(0, &[]).stdout)?);
    assert!(!place.path("-").exists());
    // Picture and report can also go the other way round.
    let run = render(&["-o", "-", "--json=report.json"])?.ends(0, &[]);
    image::load_from_memory_with_format(&run.stdout, image::ImageFormat::Png)?;
    let report: Value = serde_json::from_slice(&std::fs::read(place.path("report.json"))?)?;
    assert_eq!(report["image"]["path"], "-");
    Ok(())
}

#[test]
fn each_format_holds_the_picture_in_its_own_way() -> Tested {
    let place = Place::new()?;
    let small = ["scene.toml", "--size", "16x16", "--samples", "1", "-o"];
    let render = |name: &str| place.render(&[&small[..], &[name]].concat());
    let mut pictures = Vec::new();
    for name in ["a.exr", "a.HDR"] {
        render(name)?.ends(0, &[]);
        pictures.push(image::open(place.path(name))?.to_rgb32f());
    }
    // Both are linear; RGBE keeps 8 bits of mantissa.
    for (exr, hdr) in pictures[0].pixels().zip(pictures[1].pixels()) {
        for (exr, hdr) in exr.0.into_iter().zip(hdr.0) {
            let near = (exr - hdr).abs() <= exr.abs() / 100.0 + 1e-3;
            assert!(near, "{exr} and {hdr}");
        }
    }
    render("a.png")?.ends(0, &[]);
    let stdout = render("-")?.ends(0, &[]).stdout;
    assert_eq!(stdout, std::fs::read(place.path("a.png"))?);
    Ok(())
}

const SIZE: (u32, u32) = (24, 16);
const SIZE_TEXT: &str = "24x16";

/// What the library makes of scene.toml, changed by `overrides`.
fn library(place: &Place, overrides: &[&str], samples: Samples, variant: Variant) -> Picture {
    let options = LoadOptions {
        overrides: overrides.iter().map(|text| (*text).to_owned()).collect(),
        progress: false,
        ..LoadOptions::default()
    };
    let scene = match scene::load(&place.path("scene.toml"), &options) {
        Ok(scene) => scene,
        Err(error) => panic!("{error}"),
    };
    with_gpu(|gpu| gpu.render_at(&scene, SIZE, samples, variant).0)
}

/// The bits of an EXR file's pixels.
fn exr_bits(path: &Path) -> Result<Vec<u32>, image::ImageError> {
    let picture = image::open(path)?.to_rgba32f();
    Ok(picture.into_raw().into_iter().map(f32::to_bits).collect())
}

fn bits(picture: &Picture) -> Vec<u32> {
    let values = picture.pixels.iter().flatten();
    values.map(|value| value.to_bits()).collect()
}

#[test]
fn an_exr_is_the_librarys_picture_to_the_bit() -> Tested {
    let place = Place::new()?;
    let terms = |ambient, diffuse, specular| Terms {
        ambient,
        diffuse,
        specular,
    };
    let cases = [
        (
            Lighting::Phong,
            "phong",
            Terms::ALL,
            "ambient,diffuse,specular",
        ),
        (
            Lighting::Slides,
            "slides",
            Terms::ALL,
            "specular,diffuse,ambient",
        ),
        (
            Lighting::CORRECTED,
            "corrected",
            Terms::ALL,
            "ambient,diffuse,specular",
        ),
        (
            Lighting::Mixed(Mix::BEST),
            "best",
            Terms::ALL,
            "ambient,diffuse,specular",
        ),
        (
            Lighting::CORRECTED,
            "corrected",
            terms(true, false, false),
            "ambient",
        ),
        (
            Lighting::Phong,
            "phong",
            terms(false, true, true),
            "diffuse,specular",
        ),
    ];
    // Off the axes, so that the listing is defined.
    let overrides = [
        "material.plaster.roughness=0.4",
        "camera.position=[1, 5, 0.5]",
    ];
    let mut all = Vec::new();
    for (lighting, name, terms, terms_text) in cases {
        let set = ["--set", overrides[0], "--set", overrides[1]];
        let small = ["scene.toml", "-o", "a.exr", "--size", SIZE_TEXT];
        let model = ["--lighting", name, "--terms", terms_text];
        let render = || place.render(&[&small[..], &model, &set].concat());
        render()?.ends(0, &[]);
        let first = exr_bits(&place.path("a.exr"))?;
        std::fs::remove_file(place.path("a.exr"))?;
        render()?.ends(0, &[]);
        assert!(first == exr_bits(&place.path("a.exr"))?, "{name} twice");
        let variant = Variant { lighting, terms };
        let want = library(&place, &overrides, Samples::Four, variant);
        assert!(first == bits(&want), "{name} {terms_text}");
        assert!(!all.contains(&first), "{name} {terms_text} is like another");
        all.push(first);
    }
    Ok(())
}

#[test]
fn exposure_and_tone_mapping_change_a_png_and_no_exr() -> Tested {
    let place = Place::new()?;
    // The default.
    let best = whole(Lighting::Mixed(Mix::BEST));
    let picture = library(&place, &[], Samples::Four, best);
    let cases: [(&[&str], f32, ToneMapping); 5] = [
        (&[], 0.0, ToneMapping::Neutral),
        (&["--exposure", "-1.5"], -1.5, ToneMapping::Neutral),
        (&["--tone-mapping", "none"], 0.0, ToneMapping::None),
        (
            &["--exposure=2", "--tone-mapping=none"],
            2.0,
            ToneMapping::None,
        ),
        (
            &["--set", "camera.exposure_ev100=1"],
            1.0,
            ToneMapping::Neutral,
        ),
    ];
    let mut pngs = Vec::new();
    for (arguments, ev100, tone_mapping) in cases {
        for name in ["a.png", "a.exr"] {
            let small = ["scene.toml", "--size", SIZE_TEXT, "-o", name];
            place.render(&[&small, arguments].concat())?.ends(0, &[]);
        }
        let png = std::fs::read(place.path("a.png"))?;
        assert!(
            png == encode(&picture, PictureFormat::Png, ev100, tone_mapping)?,
            "{arguments:?}"
        );
        assert!(!pngs.contains(&png), "{arguments:?}");
        pngs.push(png);
        assert!(
            exr_bits(&place.path("a.exr"))? == bits(&picture),
            "{arguments:?}"
        );
    }
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

/// A folder with a scene of golden squares that light and eye see straight on.
fn mirrors_at_their_peak() -> Result<Place, Box<dyn std::error::Error>> {
    let place = Place::empty()?;
    let line = Vec3::new(1.7, 2.9, 4.3).normalize();
    place.write("squares.obj", &squares_across(line))?;
    let scene = format!(
        "[camera]\nposition = {0:?}\ntarget = [0, 0, 0]\nprojection = \"orthographic\"\nheight = 8\n\
         [light.lamp]\nkind = \"directional\"\ndirection = {1:?}\nilluminance = 1\n\
         [model.squares]\nfile = \"squares.obj\"\nmaterial = \"gold\"\n",
        (line * 8.0).to_array(),
        (-line).to_array()
    );
    place.write("scene.toml", &scene)?;
    Ok(place)
}

#[test]
fn a_picture_with_nan_is_written_in_each_format_and_ends_with_5() -> Tested {
    let place = mirrors_at_their_peak()?;
    // Mirrors seen at their peak: the listing divides by roughness 0.
    let small = ["scene.toml", "--size", "64x64", "--samples", "1"];
    let model = ["--lighting", "slides", "--set", "material.gold.roughness=0"];
    for name in ["a.png", "a.exr", "a.hdr"] {
        let out = ["-o", name, "--json"];
        let run = place.render(&[&small[..], &model, &out].concat())?;
        let run = run.ends(5, &["NaN", "infinity", "column", "row"]);
        let report: Value = serde_json::from_slice(&run.stdout)?;
        assert!(report["image"]["nan_pixels"].as_u64() > Some(0), "{name}");
        let picture = image::open(place.path(name))?;
        assert_eq!((picture.width(), picture.height()), (64, 64), "{name}");
    }
    let written = image::open(place.path("a.exr"))?.to_rgba32f().into_raw();
    assert!(
        written.iter().any(|value| !value.is_finite()),
        "as rendered"
    );
    Ok(())
}

#[test]
fn a_check_shows_bad_pixels_and_tells_what_makes_them_again() -> Tested {
    let place = mirrors_at_their_peak()?;
    let small = ["scene.toml", "--size", "64x64", "--check", "-o", "a.png"];
    place.render(&small)?.ends(0, &[]);
    let model = ["--lighting", "slides", "--set", "material.gold.roughness=0"];
    let run = place.render(&[&small[..], &model].concat())?;
    let run = run.ends(
        5,
        &["material 'gold'", "light 'lamp'", "slides-cook-torrance"],
    );
    // What it tells to type gives a value that is no number again.
    let told = run
        .stderr
        .lines()
        .find_map(|line| line.trim().strip_prefix("echo '"));
    let (numbers, rest) = told
        .and_then(|told| told.split_once("' | umber eval "))
        .ok_or("no line")?;
    place.write("in.csv", numbers)?;
    let again = place
        .umber(&["eval", rest, "--input", "in.csv"])?
        .ends(0, &[]);
    let value: f32 = String::from_utf8(again.stdout)?
        .lines()
        .nth(1)
        .ok_or("no value")?
        .parse()?;
    assert!(!value.is_finite() || value < 0.0, "{value}");
    // Magenta or yellow: full red, which nothing else has here.
    let picture = image::open(place.path("a.png"))?.to_rgb8();
    assert!(picture.pixels().any(|pixel| pixel.0[0] > 200));
    place
        .render(&["scene.toml", "--check", "--samples", "4"])?
        .ends(2, &["--samples"]);
    Ok(())
}
