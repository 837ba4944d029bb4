//! Do a few small pictures look as they did when somebody looked at them?
//!
//! A picture says that something changed; the physics tests say what is right. A missing or changed
//! picture fails. `BLESS=name[,name]` accepts pictures by name, one look each; only lavapipe's are
//! kept. What failed lies in `target/golden`, with a picture of the differences.

use std::path::{Path, PathBuf};

use image::{Rgb, RgbImage};
use umber::reference::shade::{Lighting, Terms};
use umber::render::{PictureFormat, ToneMapping, Variant, encode};

use crate::harness::{whole, with_gpu};
use crate::records::folder;
use crate::{tolerances, zoo};

const SIZE: (u32, u32) = (96, 54);
/// A golden picture is small, so that a change of it can be seen in a review.
const MAX_BYTES: usize = 10 << 10;
/// From the root: where the pictures are kept.
const KEPT: &str = "tests/golden";

struct Golden {
    name: &'static str,
    /// Folder and file.
    scene: (&'static str, &'static str),
    variant: Variant,
}

const fn golden(
    name: &'static str,
    scene: (&'static str, &'static str),
    lighting: Lighting,
    terms: Terms,
) -> Golden {
    let variant = Variant { lighting, terms };
    Golden {
        name,
        scene,
        variant,
    }
}

const ZOO: (&str, &str) = ("scenes", "zoo.toml");
const ROUGHNESS: (&str, &str) = ("scenes", "roughness.toml");
/// A model alone: framed by its bounds, lit by the default lights, of the materials of its MTL.
const CRATE: (&str, &str) = (KEPT, "crate.obj");
/// Three lamps with shadows.
const SHADOW: (&str, &str) = ("scenes/effects", "shadow.toml");
/// Holes.
const ALPHA_MASK: (&str, &str) = ("scenes/effects", "alpha-mask.toml");
const SPECULAR: Terms = Terms {
    specular: true,
    ..Terms::NONE
};

const GOLDEN: &[Golden] = &[
    golden("zoo_corrected", ZOO, Lighting::CORRECTED, Terms::ALL),
    golden("zoo_specular", ZOO, Lighting::CORRECTED, SPECULAR),
    golden("zoo_phong", ZOO, Lighting::Phong, Terms::ALL),
    golden(
        "roughness_corrected",
        ROUGHNESS,
        Lighting::CORRECTED,
        Terms::ALL,
    ),
    golden("roughness_slides", ROUGHNESS, Lighting::Slides, Terms::ALL),
    golden("crate", CRATE, Lighting::CORRECTED, Terms::ALL),
    golden("shadow", SHADOW, Lighting::CORRECTED, Terms::ALL),
    golden("alpha_mask", ALPHA_MASK, Lighting::CORRECTED, Terms::ALL),
];

fn kept_file(folder: &Path, name: &str) -> PathBuf {
    folder.join(name).with_extension("png")
}

/// The names in `BLESS`. Only names of pictures: whoever accepts one has looked at it.
fn blessing(text: &str) -> Result<Vec<&str>, String> {
    let names: Vec<_> = text.split(',').filter(|name| !name.is_empty()).collect();
    let known: Vec<_> = GOLDEN.iter().map(|golden| golden.name).collect();
    match names.iter().find(|name| !known.contains(name)) {
        None => Ok(names),
        Some(unknown) => Err(format!(
            "BLESS={unknown}: pictures are accepted by name, each after a look at it: {}",
            known.join(", ")
        )),
    }
}

/// For each code, how far it is from what is kept: from the range of the kept codes up to `reach`
/// pixels around, so that 0 compares pixel with pixel.
fn steps(kept: &RgbImage, actual: &RgbImage, reach: u32) -> Vec<u8> {
    let (width, height) = kept.dimensions();
    let around = |at: u32, end: u32| at.saturating_sub(reach)..(at + reach + 1).min(end);
    let step = |x: u32, y: u32, channel: usize| {
        let near = around(y, height)
            .flat_map(|y| around(x, width).map(move |x| kept.get_pixel(x, y).0[channel]));
        let (least, most) = near.fold((u8::MAX, 0), |(a, b), code| (a.min(code), b.max(code)));
        let code = actual.get_pixel(x, y).0[channel];
        code.abs_diff(code.clamp(least, most))
    };
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    pixels
        .flat_map(|(x, y)| [0, 1, 2].map(|channel| step(x, y, channel)))
        .collect()
}

/// How far two pictures of one size are apart, in steps of their 8-bit codes.
struct Difference {
    /// The share of codes that differ by more than one.
    share: f64,
    max: u8,
    mean: f64,
    /// Column and row of the first pixel that differs by more than one.
    first: Option<(u32, u32)>,
}

impl Difference {
    fn of(steps: &[u8], width: u32) -> Self {
        let count = steps.len().max(1) as f64;
        let pixel = steps
            .iter()
            .position(|step| *step > 1)
            .map(|code| code as u32 / 3);
        Self {
            share: steps.iter().filter(|step| **step > 1).count() as f64 / count,
            max: steps.iter().copied().max().unwrap_or(0),
            mean: steps.iter().map(|step| f64::from(*step)).sum::<f64>() / count,
            first: pixel.map(|pixel| (pixel % width, pixel / width)),
        }
    }
}

/// False colours: black where pictures agree, blue for one step, then green, yellow and red for
/// more, and white for what is another picture.
fn false_colours(steps: &[u8], width: u32, height: u32) -> RgbImage {
    RgbImage::from_fn(width, height, |x, y| {
        let pixel = (y * width + x) as usize * 3;
        let largest = steps[pixel..pixel + 3].iter().max();
        Rgb(match largest.copied().unwrap_or(0) {
            0 => [0, 0, 0],
            1 => [0, 0, 160],
            2..=7 => [0, 200, 0],
            8..=31 => [230, 200, 0],
            32..=95 => [230, 0, 0],
            96.. => [255, 255, 255],
        })
    })
}

/// What a picture is compared with, and what is left where it is not the same.
struct Places {
    kept: PathBuf,
    failed: PathBuf,
    /// How far an edge may be from its kept place, pixels.
    reach: u32,
}

impl Places {
    fn leftovers(&self, name: &str) -> [PathBuf; 2] {
        ["actual", "diff"].map(|what| self.failed.join(format!("{name}.{what}.png")))
    }

    /// Removes what an earlier failure left, if there was one.
    fn tidy(&self, name: &str) {
        for old in self.leftovers(name) {
            let _ = std::fs::remove_file(old);
        }
    }

    /// Compares a picture with the kept one of this name.
    fn compare(&self, name: &str, png: &[u8]) -> Result<(), String> {
        let [actual_file, diff_file] = self.leftovers(name);
        self.tidy(name);
        let text = |error: &dyn std::fmt::Display| format!("{name}: {error}");
        let actual = image::load_from_memory(png)
            .map_err(|e| text(&e))?
            .to_rgb8();
        let failed = |reason: String| {
            std::fs::write(&actual_file, png).map_err(|e| text(&e))?;
            let place = actual_file.display();
            Err(format!(
                "{name}: {reason}\n  the picture is {place}; after a look at it, BLESS={name} accepts it"
            ))
        };
        let file = kept_file(&self.kept, name);
        if !file.exists() {
            return failed(format!("there is no {}", file.display()));
        }
        let kept = image::open(&file).map_err(|e| text(&e))?.to_rgb8();
        if kept.dimensions() != actual.dimensions() {
            return failed(format!("{:?} are kept", kept.dimensions()));
        }
        let (width, height) = kept.dimensions();
        let steps = steps(&kept, &actual, self.reach);
        let Difference {
            share,
            max,
            mean,
            first,
        } = Difference::of(&steps, width);
        if share <= tolerances::GOLDEN_SHARE {
            return Ok(());
        }
        false_colours(&steps, width, height)
            .save(&diff_file)
            .map_err(|e| text(&e))?;
        failed(format!(
            "{share:.4} of the codes differ by more than one step, at most {} may; the most by {max}, \
             by {mean:.3} in the mean, the first in column and row {first:?}; see {}",
            tolerances::GOLDEN_SHARE,
            diff_file.display()
        ))
    }

    /// Keeps a picture that somebody has looked at.
    fn bless(&self, name: &str, png: &[u8]) -> Result<(), String> {
        self.tidy(name);
        std::fs::create_dir_all(&self.kept)
            .and_then(|()| std::fs::write(kept_file(&self.kept, name), png))
            .map_err(|error| format!("{name}: {error}"))
    }
}

/// lavapipe's pictures are kept, and compared pixel with pixel. Another driver may snap corners to
/// 1/16 pixel where lavapipe takes 1/256, so that an edge falls on the other side of a pixel's middle.
fn places(is_lavapipe: bool) -> Places {
    Places {
        reach: u32::from(!is_lavapipe),
        kept: Path::new(env!("CARGO_MANIFEST_DIR")).join(KEPT),
        failed: folder("golden"),
    }
}

fn check_size(name: &str, png: &[u8]) -> Result<(), String> {
    match png.len() {
        0..=MAX_BYTES => Ok(()),
        bytes => Err(format!("{name}: {bytes} bytes, more than {MAX_BYTES}")),
    }
}

fn check(golden: &Golden, blessed: &[&str]) -> Result<(), String> {
    let (folder, file) = golden.scene;
    let scene = zoo::load_from(folder, file);
    let (picture, is_lavapipe) =
        with_gpu(|gpu| (gpu.render(&scene, SIZE, golden.variant), gpu.is_lavapipe()));
    let ev100 = scene.camera.exposure_ev100;
    let png = encode(&picture, PictureFormat::Png, ev100, ToneMapping::Neutral)
        .map_err(|error| format!("{}: {error}", golden.name))?;
    check_size(golden.name, &png)?;
    if !blessed.contains(&golden.name) {
        return places(is_lavapipe).compare(golden.name, &png);
    }
    if !is_lavapipe {
        return Err(format!(
            "{}: only lavapipe's pictures are kept",
            golden.name
        ));
    }
    places(is_lavapipe).bless(golden.name, &png)
}

#[test]
fn pictures_are_as_blessed() {
    let text = std::env::var("BLESS").unwrap_or_default();
    let blessed = blessing(&text).unwrap_or_else(|message| panic!("{message}"));
    let failures: Vec<_> = GOLDEN
        .iter()
        .filter_map(|g| check(g, &blessed).err())
        .collect();
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn every_kept_picture_has_a_test_and_is_small() -> Result<(), Box<dyn std::error::Error>> {
    for entry in std::fs::read_dir(places(true).kept)? {
        let path = entry?.path();
        if path.extension().is_some_and(|ending| ending == "png") {
            let stem = path.file_stem().and_then(|stem| stem.to_str());
            let known = GOLDEN.iter().any(|golden| Some(golden.name) == stem);
            assert!(known, "{} belongs to no test", path.display());
            check_size(&path.display().to_string(), &std::fs::read(&path)?)?;
            assert_eq!(image::image_dimensions(&path)?, SIZE, "{}", path.display());
        }
    }
    Ok(())
}

#[test]
fn the_crate_is_made_of_its_mtl() {
    let scene = zoo::load_from(CRATE.0, CRATE.1);
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
    let names: Vec<_> = scene.materials.iter().map(|m| m.name.as_str()).collect();
    assert_eq!(names, ["paint", "copper"]);
    // Each key of the file counts: without the MTL the picture is another.
    let mut plain = scene.clone();
    plain.materials = vec![plain.materials[0].clone(); 2];
    let [with, without] = [&scene, &plain]
        .map(|scene| with_gpu(|gpu| gpu.render(scene, SIZE, whole(Lighting::CORRECTED))));
    let changed = with
        .pixels
        .iter()
        .zip(&without.pixels)
        .filter(|(a, b)| a != b)
        .count();
    assert!(changed > 200, "the roof covers {changed} pixels");
}

#[test]
fn a_picture_is_accepted_by_its_name_only() {
    assert_eq!(blessing(""), Ok(vec![]));
    assert_eq!(blessing("crate"), Ok(vec!["crate"]));
    assert_eq!(blessing("crate,zoo_phong"), Ok(vec!["crate", "zoo_phong"]));
    for wrong in ["all", "1", "true", "*", "zoo", "crate,all"] {
        let message = blessing(wrong).expect_err(wrong);
        assert!(
            message.contains("by name") && message.contains("zoo_phong"),
            "{message}"
        );
    }
}

#[test]
fn an_edge_may_move_on_another_driver_and_nothing_more() {
    let line =
        |at: u32| RgbImage::from_fn(8, 4, |x, _| Rgb(if x < at { [200; 3] } else { [40; 3] }));
    let worst = |actual: &RgbImage, reach| Difference::of(&steps(&line(4), actual, reach), 8).max;
    assert_eq!(worst(&line(5), 0), 160);
    assert_eq!(worst(&line(5), 1), 0);
    assert_eq!(worst(&line(3), 1), 0);
    assert_eq!(worst(&line(6), 1), 160, "by two pixels");
    let mut spot = line(4);
    spot.put_pixel(7, 3, Rgb([40, 45, 40]));
    assert_eq!(worst(&spot, 1), 5, "a colour that is nowhere near");
}

/// An 8 x 4 picture of grey 40 in which one pixel has another red.
fn grey_but_for(x: u32, y: u32, red: u8) -> RgbImage {
    let mut picture = RgbImage::from_pixel(8, 4, Rgb([40; 3]));
    picture.get_pixel_mut(x, y).0[0] = red;
    picture
}

fn png(picture: &RgbImage) -> image::ImageResult<Vec<u8>> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    picture.write_to(&mut bytes, image::ImageFormat::Png)?;
    Ok(bytes.into_inner())
}

#[test]
fn a_missing_or_different_picture_is_told_shown_and_accepted()
-> Result<(), Box<dyn std::error::Error>> {
    let root = tempfile::tempdir()?;
    let places = Places {
        kept: root.path().join("kept"),
        failed: root.path().to_owned(),
        reach: 0,
    };
    let [actual, diff] = places.leftovers("grey");
    let grey = grey_but_for(0, 0, 40);
    let message = places.compare("grey", &png(&grey)?).expect_err("missing");
    assert!(
        message.contains("there is no") && message.contains("BLESS=grey"),
        "{message}"
    );
    assert!(actual.exists() && !diff.exists());
    places.bless("grey", &png(&grey)?)?;
    places.compare("grey", &png(&grey)?)?;
    assert!(!actual.exists(), "what failed before is gone");
    // A step of one is within the rounding of another driver.
    places.compare("grey", &png(&grey_but_for(5, 2, 41))?)?;
    let other = grey_but_for(5, 2, 90);
    let message = places
        .compare("grey", &png(&other)?)
        .expect_err("different");
    for words in [
        "by 50,",
        "by 0.521 in the mean",
        "Some((5, 2))",
        "0.0104 of the codes",
        "BLESS=grey",
    ] {
        assert!(message.contains(words), "no '{words}': {message}");
    }
    assert_eq!(image::open(&actual)?.to_rgb8(), other);
    let shown = image::open(&diff)?.to_rgb8();
    assert_eq!(shown.get_pixel(5, 2).0, [230, 0, 0]);
    assert_eq!(shown.pixels().filter(|pixel| pixel.0 != [0; 3]).count(), 1);
    places.compare("grey", &png(&grey)?)?;
    assert!(!actual.exists() && !diff.exists(), "and again");
    let wide = RgbImage::from_pixel(9, 4, Rgb([40; 3]));
    let message = places
        .compare("grey", &png(&wide)?)
        .expect_err("another size");
    assert!(message.contains("(8, 4) are kept"), "{message}");
    assert!(check_size("grey", &[0; MAX_BYTES]).is_ok());
    assert!(check_size("grey", &[0; MAX_BYTES + 1]).is_err());
    Ok(())
}
