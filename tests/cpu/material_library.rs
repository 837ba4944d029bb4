//! Do the built-in materials have physical numbers?

use std::fs;

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
            assert!(material.f0.iter().all(|&f0| f0 > 0.4), "{name}");
        } else {
            // Diamond, the densest of common clear stuffs, has 0.17; none here is near it.
            assert!(
                material.f0.iter().all(|&f0| (0.02..0.06).contains(&f0)),
                "{name}"
            );
        }
    }
}

#[test]
fn f0_of_metals_is_fresnel_of_the_measured_index() {
    // n and k of Johnson and Christy (1972; iron 1974), the two measured wavelengths around each of
    // 610, 549 and 468 nm: (wavelength, n, k).
    type Measured = (f64, f64, f64);
    let gold: [[Measured; 2]; 3] = [
        [(582.1, 0.29, 2.863), (616.8, 0.21, 3.272)],
        [(548.6, 0.43, 2.455), (582.1, 0.29, 2.863)],
        [(450.9, 1.38, 1.914), (471.4, 1.31, 1.849)],
    ];
    let copper: [[Measured; 2]; 3] = [
        [(582.1, 0.70, 2.704), (616.8, 0.30, 3.205)],
        [(548.6, 1.02, 2.577), (582.1, 0.70, 2.704)],
        [(450.9, 1.24, 2.397), (471.4, 1.25, 2.483)],
    ];
    let iron: [[Measured; 2]; 3] = [
        [(582.0, 2.94, 2.99), (617.0, 2.88, 3.05)],
        [(521.0, 2.86, 2.91), (549.0, 2.95, 2.93)],
        [(451.0, 2.59, 2.77), (471.0, 2.67, 2.82)],
    ];
    for (name, table) in [("gold", gold), ("copper", copper), ("metal", iron)] {
        let f0 = material(name).f0;
        for (channel, wavelength) in [610.0, 549.0, 468.0].into_iter().enumerate() {
            let [a, b] = table[channel];
            let part = (wavelength - a.0) / (b.0 - a.0);
            let n = a.1 + part * (b.1 - a.1);
            let k = a.2 + part * (b.2 - a.2);
            let wanted = ((n - 1.0).powi(2) + k * k) / ((n + 1.0).powi(2) + k * k);
            let error = (f64::from(f0[channel]) - wanted).abs();
            // The library is written with four decimals.
            assert!(
                error < 1e-4,
                "{name} at {wavelength} nm: {} for {wanted}",
                f0[channel]
            );
        }
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
