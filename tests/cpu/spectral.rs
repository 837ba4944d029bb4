//! Does the curve of each metal follow its spectrum at every angle, and are the colours the known ones?

use umber::reference::metal::Metal;
use umber::reference::spectral::{METALS, f};
use umber::reference::wavelengths::Spectrum;

use crate::tolerances::{FOUR_DECIMALS, SPECTRAL_FIT, THREE_DECIMALS};

fn metals() -> impl Iterator<Item = (&'static str, Spectrum, Metal)> {
    METALS
        .iter()
        .map(|metal| (metal.name, metal.spectrum(), metal.metal()))
}

#[test]
fn the_fit_follows_the_integral() {
    for (name, spectrum, metal) in metals() {
        let mut worst = 0.0_f64;
        // Between the angles that it was fitted at, too.
        for step in 0..=900 {
            let mu = (f64::from(step) * 0.1).to_radians().cos();
            let off = f(metal.f0, metal.coefficients, mu) - spectrum.reflectance(mu);
            worst = worst.max(off.abs().max_element());
        }
        println!("{name}: within {worst:.5}; {:?}", metal.coefficients);
        assert!(worst <= SPECTRAL_FIT, "{name}: {worst}");
    }
}

/// The library's numbers, which were integrated elsewhere; gold's red lies outside sRGB.
#[test]
fn colours_are_the_known_ones() {
    let known = [
        ("gold", [1.0285, 0.7341, 0.3637]),
        ("copper", [0.9261, 0.6271, 0.5200]),
    ];
    for (name, want) in known {
        let found = metals().find(|(metal, ..)| *metal == name);
        let (_, _, metal) = found.expect("a metal");
        for (got, want) in metal.f0.to_array().into_iter().zip(want) {
            assert!((got - want).abs() <= FOUR_DECIMALS, "{name}: {}", metal.f0);
        }
    }
}

/// MODELS: blue over red of gold at 0, 60, 75 and 85 degrees.
#[test]
fn gold_loses_its_colour_towards_grazing() {
    let (_, spectrum, _) = metals().next().expect("gold");
    for (degrees, want) in [
        (0.0_f64, 0.354),
        (60.0, 0.395),
        (75.0, 0.515),
        (85.0, 0.759),
    ] {
        let colour = spectrum.reflectance(degrees.to_radians().cos());
        let ratio = colour.z / colour.x;
        assert!((ratio - want).abs() <= THREE_DECIMALS, "{degrees}: {ratio}");
    }
}

#[test]
fn white_reflects_white() {
    // A metal that is a mirror at every wavelength has no colour: so has grazing.
    for (name, spectrum, _) in metals() {
        let grazing = spectrum.reflectance(0.0);
        assert!(
            (grazing - 1.0).abs().max_element() <= FOUR_DECIMALS,
            "{name}: {grazing}"
        );
    }
}
