//! Do a few small pictures look as they did when somebody looked at them?
//!
//! A picture says that something changed; the physics tests say what is right. A missing or changed
//! picture fails; `BLESS=name` accepts one by name, and only lavapipe's are kept.

use std::path::{Path, PathBuf};

use umber::reference::shade::Lighting;
use umber::render::{PictureFormat, ToneMapping, encode, srgb_codes};

use crate::harness::{whole, with_gpu};
use crate::{tolerances, zoo};

const SIZE: (u32, u32) = (96, 54);
/// A golden picture is small, so that a change of it can be seen in a review.
const MAX_BYTES: usize = 8 << 10;

struct Golden {
    name: &'static str,
    scene: &'static str,
    lighting: Lighting,
}

const GOLDEN: &[Golden] = &[
    Golden {
        name: "zoo_corrected",
        scene: "zoo.toml",
        lighting: Lighting::Corrected,
    },
    Golden {
        name: "zoo_phong",
        scene: "zoo.toml",
        lighting: Lighting::Phong,
    },
    Golden {
        name: "roughness_corrected",
        scene: "roughness.toml",
        lighting: Lighting::Corrected,
    },
];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn kept(name: &str) -> PathBuf {
    root().join("tests/golden").join(name).with_extension("png")
}

fn blessed(name: &str) -> bool {
    std::env::var("BLESS").is_ok_and(|names| names.split(',').any(|n| n == name))
}

/// The codes that differ by more than one step, as a share, and the largest difference.
fn difference(kept: &[u8], actual: &[u8]) -> (f64, u8) {
    let differences = kept.iter().zip(actual).map(|(a, b)| a.abs_diff(*b));
    let far = differences.clone().filter(|d| *d > 1).count();
    (
        far as f64 / kept.len() as f64,
        differences.max().unwrap_or(0),
    )
}

fn compare(golden: &Golden) -> Result<(), String> {
    let text = |error: &dyn std::fmt::Display| format!("{}: {error}", golden.name);
    let scene = zoo::load(golden.scene);
    let (picture, is_lavapipe) = with_gpu(|gpu| {
        (
            gpu.render(&scene, SIZE, whole(golden.lighting)),
            gpu.is_lavapipe(),
        )
    });
    let ev100 = scene.camera.exposure_ev100;
    let png =
        encode(&picture, PictureFormat::Png, ev100, ToneMapping::Neutral).map_err(|e| text(&e))?;
    if png.len() > MAX_BYTES {
        return Err(text(&format!("{} bytes, more than {MAX_BYTES}", png.len())));
    }
    let file = kept(golden.name);
    if blessed(golden.name) && is_lavapipe {
        return std::fs::write(&file, png).map_err(|e| text(&e));
    }
    let kept = image::open(&file)
        .map_err(|e| {
            format!(
                "{}: {e}\nto accept a new one: BLESS={}",
                file.display(),
                golden.name
            )
        })?
        .to_rgb8();
    let actual = srgb_codes(&picture, ev100, ToneMapping::Neutral);
    let (share, largest) = difference(kept.as_raw(), &actual);
    if kept.dimensions() != SIZE || share > tolerances::GOLDEN_SHARE {
        let beside = root()
            .join("target")
            .join(format!("{}.actual.png", golden.name));
        std::fs::write(&beside, png).map_err(|e| text(&e))?;
        return Err(text(&format!(
            "{share:.4} of the codes differ by more than one step, the most by {largest}; see {}",
            beside.display()
        )));
    }
    Ok(())
}

#[test]
fn pictures_are_as_blessed() {
    let failures: Vec<_> = GOLDEN
        .iter()
        .filter_map(|golden| compare(golden).err())
        .collect();
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn every_kept_picture_has_a_test() -> std::io::Result<()> {
    for entry in std::fs::read_dir(root().join("tests/golden"))? {
        let path = entry?.path();
        let stem = path.file_stem().and_then(|stem| stem.to_str());
        let known = GOLDEN.iter().any(|golden| Some(golden.name) == stem);
        assert!(known, "{} belongs to no test", path.display());
    }
    Ok(())
}

#[test]
fn a_picture_that_is_a_little_different_is_found() {
    let kept = [10, 20, 30, 40];
    assert_eq!(difference(&kept, &[11, 19, 30, 40]), (0.0, 1));
    assert_eq!(difference(&kept, &[10, 20, 30, 45]), (0.25, 5));
}
