//! What did the corrections change, and by how much does it show?
//!
//! `cargo test --test gpu corrections -- --nocapture` prints the README's table.

use glam::Vec3;
use umber::reference::shade::{Lighting, Terms};
use umber::render::{Picture, ToneMapping, Variant, srgb_codes};

use crate::harness::{TERM_SETS, with_gpu};
use crate::patches::{DARK, Patch, Patches, material, towards};
use crate::tolerances;
use crate::zoo;

/// The sum of a picture's radiances over pixels and channels.
fn total(picture: &Picture) -> f64 {
    let channels = picture.pixels.iter().flat_map(|[r, g, b, _]| [r, g, b]);
    channels.map(|value| f64::from(*value)).sum()
}

fn name(terms: Terms) -> &'static str {
    match (terms.ambient, terms.diffuse, terms.specular) {
        (true, false, false) => "ambient",
        (false, true, false) => "diffuse",
        (false, false, true) => "specular",
        _ => "all",
    }
}

#[test]
fn the_zoo_by_the_listing_and_corrected() {
    let scene = zoo::load("zoo.toml");
    let ev100 = scene.camera.exposure_ev100;
    println!("| term | light, slides / corrected | codes that differ by over 1 | mean | largest |");
    println!("| --- | --- | --- | --- | --- |");
    let mut ratios = Vec::new();
    for terms in TERM_SETS {
        let [slides, corrected] = [Lighting::Slides, Lighting::CORRECTED].map(|lighting| {
            with_gpu(|gpu| gpu.render(&scene, (640, 360), Variant { lighting, terms }))
        });
        let codes = |picture| srgb_codes(picture, ev100, ToneMapping::Neutral);
        let differences: Vec<u8> = codes(&slides)
            .into_iter()
            .zip(codes(&corrected))
            .map(|(a, b)| a.abs_diff(b))
            .collect();
        let count = differences.len() as f64;
        let differing = differences.iter().filter(|d| **d > 1).count() as f64 / count;
        let mean = differences.iter().map(|d| f64::from(*d)).sum::<f64>() / count;
        let largest = differences.iter().max().copied().unwrap_or(0);
        let ratio = total(&slides) / total(&corrected);
        println!(
            "| {} | {ratio:.3} | {:.1} % | {mean:.2} | {largest} |",
            name(terms),
            differing * 100.0
        );
        ratios.push(ratio);
    }
    let [_, diffuse, specular, _] = ratios[..] else {
        panic!("{} term sets", ratios.len());
    };
    // The interface takes its share before the base gets the rest: the listing's base is brighter.
    assert!(diffuse > 1.02 && diffuse < 1.3, "{diffuse}");
    // 4/pi where the light's own size does not widen the lobe.
    assert!(specular > 1.1 && specular < 1.4, "{specular}");
}

#[test]
fn the_listings_highlight_is_4_over_pi_too_bright() {
    let to_eye = Vec3::new(0.2, 0.3, 0.9).normalize();
    let patches: Vec<_> = (0..100)
        .map(|i| Patch {
            normal: (to_eye + Vec3::new((i % 10) as f32, (i / 10) as f32, 0.0) * 0.05).normalize(),
            material: material([0.0; 3], [0.3; 3], 0.5),
        })
        .collect();
    let patches = Patches {
        to_eye,
        lights: vec![towards(Vec3::new(0.5, 0.1, 0.8).normalize(), [1.0; 3])],
        ambient: DARK,
        patches,
    };
    let [slides, corrected] = [Lighting::Slides, Lighting::CORRECTED].map(|lighting| {
        let terms = Terms {
            specular: true,
            ..Terms::NONE
        };
        with_gpu(|gpu| patches.rendered(gpu, Variant { lighting, terms }))
    });
    for (slides, corrected) in slides.into_iter().zip(corrected) {
        let ratio = f64::from(slides[0]) / f64::from(corrected[0]);
        let want = 4.0 / std::f64::consts::PI;
        assert!(
            tolerances::LISTING_PIXEL.holds(ratio, want),
            "{ratio} for {want}"
        );
    }
}
