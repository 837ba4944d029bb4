//! Is the picture that models are held against the one that f64 predicts, and does a frame that keeps its shadow maps look the same?

use std::error::Error;
use std::path::Path;

use umber::gpu::Samples;
use umber::reference::ladders::{Fresnel, Mix};
use umber::reference::shade::Lighting;
use umber::render::effects::{EffectSet, Effects};
use umber::render::{Frame, Inspection, Picture, Settings, Uploaded};
use umber::scene::{LoadOptions, Scene, load};
use umber::studies::cost::{Sight, made_opaque};

use crate::harness::{Gpu, whole, with_gpu};
use crate::tolerances;

const SIZE: (u32, u32) = (96, 54);

fn scene(name: &str) -> Result<Scene, umber::scene::Error> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("scenes")
        .join(name);
    let scene = load(&path, &LoadOptions::default())?;
    Ok(made_opaque(&scene))
}

/// The reference picture of a scene, and what a frame of `lighting` leaves.
fn both(
    gpu: &Gpu,
    scene: &Scene,
    lighting: Lighting,
) -> Result<(Picture, Picture), Box<dyn Error>> {
    let uploaded = Uploaded::new(&gpu.renderer, scene, EffectSet::ALL)?;
    let sight = Sight::new(&gpu.renderer, &uploaded, scene, SIZE)?;
    let mut frame = sight.frame(lighting)?;
    frame.draw()?;
    Ok((sight.reference().clone(), frame.picture()?))
}

/// Values of all three channels, the frame's and the reference's.
fn values(reference: &Picture, frame: &Picture) -> Vec<(f64, f64)> {
    let pairs = frame.pixels.iter().zip(&reference.pixels);
    let rgb = |pixel: &[f32; 4]| [pixel[0], pixel[1], pixel[2]].map(f64::from);
    pairs
        .flat_map(|(frame, reference)| rgb(frame).into_iter().zip(rgb(reference)))
        .collect()
}

/// Metals by their spectra; clear stuff under shadows, lamps of every kind and maps by Fresnel's equations. What a frame and f64 shade
/// is the same then, and only rounding differs.
#[test]
fn the_reference_is_what_the_highest_tiers_draw() -> Result<(), Box<dyn Error>> {
    let dielectric = Mix {
        fresnel: Fresnel::Dielectric,
        ..Mix::BEST
    };
    for (name, mix) in [
        ("colour-shift.toml", Mix::BEST),
        ("effects/shadow.toml", dielectric),
        ("effects/spot-light.toml", dielectric),
        ("effects/normal-map.toml", dielectric),
        ("effects/occlusion-map.toml", dielectric),
        ("effects/emission-map.toml", dielectric),
    ] {
        let scene = scene(name)?;
        let lighting = Lighting::Mixed(mix);
        let (reference, frame) = with_gpu(|gpu| both(gpu, &scene, lighting))?;
        let lit = reference.pixels.iter().filter(|pixel| pixel[1] > 0.0);
        assert!(lit.count() > 500, "{name} is dark");
        let tolerance = tolerances::pixel(lighting);
        let mut worst = 0.0_f64;
        for (got, want) in values(&reference, &frame) {
            worst = worst.max(tolerance.share(got, want));
        }
        println!("{name}: the worst pixel takes {worst:.3} of the tolerance");
        assert!(worst <= 1.0, "{name}: {worst}");
    }
    Ok(())
}

/// And another model is told from it.
#[test]
fn the_reference_is_not_what_the_slides_draw() -> Result<(), Box<dyn Error>> {
    let scene = scene("colour-shift.toml")?;
    let (reference, frame) = with_gpu(|gpu| both(gpu, &scene, Lighting::Slides))?;
    let pairs = values(&reference, &frame);
    let off = pairs
        .iter()
        .filter(|(got, want)| (got - want).abs() > 0.1 * want);
    assert!(off.count() > pairs.len() / 4);
    Ok(())
}

#[test]
fn a_frame_on_kept_shadow_maps_is_the_same_bit_by_bit() -> Result<(), Box<dyn Error>> {
    let scene = scene("effects/shadow.toml")?;
    with_gpu(|gpu| {
        let settings = Settings {
            width: SIZE.0,
            height: SIZE.1,
            samples: Samples::One,
            variant: whole(Lighting::CORRECTED),
            effects: Effects::default(),
        };
        let uploaded = Uploaded::new(&gpu.renderer, &scene, EffectSet::ALL)?;
        let mut first = Frame::new(&gpu.renderer, &uploaded, &settings)?;
        let drawn = first.draw()?;
        let mut second = Frame::after(&first, &settings, Inspection::Nothing)?;
        for _ in 0..2 {
            let kept = second.draw()?;
            let names = |passes: &[umber::gpu::PassCounts]| -> Vec<String> {
                passes.iter().map(|pass| pass.name.clone()).collect()
            };
            assert_eq!(names(&drawn.passes), ["shadow", "shading"]);
            assert_eq!(names(&kept.passes), ["shading"]);
            assert_eq!(second.picture()?.hash(), first.picture()?.hash());
        }
        Ok(())
    })
}
