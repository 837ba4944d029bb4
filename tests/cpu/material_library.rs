//! Do the built-in materials have physical numbers?

use std::fs;

use glam::{DMat3, DVec3};
use umber::scene::{
    self, LoadOptions, MAX_SHININESS, Material, roughness_from_shininess, shininess_from_roughness,
};

const NAMES: [&str; 10] = [
    "glass", "wood", "plaster", "plastic", "carpet", "skin", "metal", "dirt", "gold", "copper",
];

/// A material as a scene without any numbers of its own has it.
fn material(name: &str) -> Material {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("scene.toml");
    let text = format!("[model.ball]\nshape = \"sphere\"\nmaterial = \"{name}\"\n");
    fs::write(&path, text).expect("a written file");
    let mut scene = scene::load(&path, &LoadOptions::default()).expect("a good scene");
    scene.materials.remove(0)
}

#[test]
fn no_material_reflects_more_than_it_receives() {
    for name in NAMES {
        let material = material(name);
        assert_eq!(material.name, name);
        for channel in 0..3 {
            let total = material.albedo[channel] + material.f0[channel];
            assert!((0.02..=1.0).contains(&total), "{name}: {total}");
            assert_eq!(material.emission[channel], 0.0);
        }
        assert!((0.0..=1.0).contains(&material.roughness), "{name}");
        assert_eq!(material.opacity < 1.0, name == "glass", "{name}");
    }
}

#[test]
fn only_metals_reflect_much_straight_on_and_they_have_no_diffuse_part() {
    for name in NAMES {
        let material = material(name);
        if ["metal", "gold", "copper"].contains(&name) {
            assert_eq!(material.albedo, [0.0; 3], "{name}");
            assert!(material.f0.iter().all(|&f0| f0 > 0.3), "{name}");
        } else {
            // Diamond, the densest of common clear stuffs, has 0.17; none here is near it.
            assert!(
                material.f0.iter().all(|&f0| (0.02..0.06).contains(&f0)),
                "{name}"
            );
        }
    }
}

/// Wavelength in nm, n, k.
type Measured = (f64, f64, f64);

/// Johnson and Christy 1972.
const GOLD: [Measured; 16] = [
    (367.9, 1.48, 1.895),
    (381.5, 1.46, 1.933),
    (397.4, 1.47, 1.952),
    (413.3, 1.46, 1.958),
    (430.5, 1.45, 1.948),
    (450.9, 1.38, 1.914),
    (471.4, 1.31, 1.849),
    (495.9, 1.04, 1.833),
    (520.9, 0.62, 2.081),
    (548.6, 0.43, 2.455),
    (582.1, 0.29, 2.863),
    (616.8, 0.21, 3.272),
    (659.5, 0.14, 3.697),
    (704.5, 0.13, 4.103),
    (756.0, 0.14, 4.542),
    (821.1, 0.16, 5.083),
];
/// Johnson and Christy 1972.
const COPPER: [Measured; 16] = [
    (367.9, 1.36, 1.975),
    (381.5, 1.33, 2.045),
    (397.4, 1.32, 2.116),
    (413.3, 1.28, 2.207),
    (430.5, 1.25, 2.305),
    (450.9, 1.24, 2.397),
    (471.4, 1.25, 2.483),
    (495.9, 1.22, 2.564),
    (520.9, 1.18, 2.608),
    (548.6, 1.02, 2.577),
    (582.1, 0.7, 2.704),
    (616.8, 0.3, 3.205),
    (659.5, 0.22, 3.747),
    (704.5, 0.21, 4.205),
    (756.0, 0.24, 4.665),
    (821.1, 0.26, 5.18),
];
/// Johnson and Christy 1974, around 610, 549 and 468 nm.
const IRON: [Measured; 6] = [
    (451.0, 2.59, 2.77),
    (471.0, 2.67, 2.82),
    (521.0, 2.86, 2.91),
    (549.0, 2.95, 2.93),
    (582.0, 2.94, 2.99),
    (617.0, 2.88, 3.05),
];

/// Fresnel's reflectance straight on, between the two measured wavelengths around `nm`.
fn reflectance(table: &[Measured], nm: f64) -> f64 {
    let next = table
        .partition_point(|row| row.0 < nm)
        .clamp(1, table.len() - 1);
    let (a, b) = (table[next - 1], table[next]);
    let part = (nm - a.0) / (b.0 - a.0);
    let (n, k) = (a.1 + part * (b.1 - a.1), a.2 + part * (b.2 - a.2));
    ((n - 1.0).powi(2) + k * k) / ((n + 1.0).powi(2) + k * k)
}

/// CIE 1931 colour matching, Wyman, Sloan and Shirley 2013, table 1.
fn color_matching(nm: f64) -> DVec3 {
    let lobe = |mean: f64, below: f64, above: f64| {
        let width = if nm < mean { below } else { above };
        (-0.5 * ((nm - mean) / width).powi(2)).exp()
    };
    DVec3::new(
        1.056 * lobe(599.8, 37.9, 31.0) + 0.362 * lobe(442.0, 16.0, 26.7)
            - 0.065 * lobe(501.1, 20.4, 26.2),
        0.821 * lobe(568.8, 46.9, 40.5) + 0.286 * lobe(530.9, 16.3, 31.1),
        1.217 * lobe(437.0, 11.8, 36.0) + 0.681 * lobe(459.0, 26.0, 13.8),
    )
}

/// Linear sRGB of a reflectance under a black body of 6504 K, white held to (1, 1, 1).
fn color(table: &[Measured]) -> DVec3 {
    let (mut reflected, mut white) = (DVec3::ZERO, DVec3::ZERO);
    for nm in (390..=780).step_by(2).map(f64::from) {
        // Planck's law; hc/k = 1.438777e7 nm K.
        let power = nm.powi(-5) / (1.438_777e7 / (nm * 6504.0)).exp_m1();
        let seen = color_matching(nm) * power;
        white += seen;
        reflected += seen * reflectance(table, nm);
    }
    let xyz = reflected / white * DVec3::new(0.95047, 1.0, 1.08883);
    // IEC 61966-2-1.
    let to_srgb = DMat3::from_cols(
        DVec3::new(3.2404542, -0.9692660, 0.0556434),
        DVec3::new(-1.5371385, 1.8760108, -0.2040259),
        DVec3::new(-0.4985314, 0.0415560, 1.0572252),
    );
    to_srgb * xyz
}

#[test]
fn f0_of_gold_and_copper_is_their_spectrum_seen_by_the_eye() {
    for (name, table) in [("gold", GOLD), ("copper", COPPER)] {
        let wanted = color(&table).min(DVec3::ONE).to_array();
        for (got, wanted) in material(name).f0.into_iter().zip(wanted) {
            let error = (f64::from(got) - wanted).abs();
            // The library is written with four decimals.
            assert!(error < 1e-4, "{name}: {got} for {wanted}");
        }
    }
}

#[test]
fn f0_of_iron_is_fresnel_of_the_measured_index() {
    for (got, nm) in material("metal").f0.into_iter().zip([610.0, 549.0, 468.0]) {
        let wanted = reflectance(&IRON, nm);
        let error = (f64::from(got) - wanted).abs();
        assert!(error < 1e-4, "{nm} nm: {got} for {wanted}");
    }
}

#[test]
fn shininess_follows_roughness() {
    for name in NAMES {
        let material = material(name);
        let wanted = shininess_from_roughness(f64::from(material.roughness));
        assert!(
            (f64::from(material.shininess) - wanted).abs() < 1e-3,
            "{name}"
        );
    }
    assert_eq!(shininess_from_roughness(1.0), 0.0);
    assert_eq!(shininess_from_roughness(0.0), f64::from(MAX_SHININESS));
    for n in [0.0, 1.0, 10.0, 1000.0] {
        let back = shininess_from_roughness(roughness_from_shininess(n));
        assert!(
            (back - n).abs() < 1e-9 * (n + 1.0),
            "{n} comes back as {back}"
        );
    }
}
