//! How far are the Fresnel terms of metals from Fresnel's equations, integrated over wavelength?

use glam::DVec3;

use crate::reference::ladders::Fresnel;
use crate::reference::reflectance::Reflectance;
use crate::reference::spectral::METALS;
use crate::report::{ModelCase, ModelRow};

/// Angles, half a degree apart.
const ANGLES: u32 = 180;

/// A row for each tier, a case for each metal. Errors are absolute, of the worst channel.
pub fn rows() -> Vec<ModelRow> {
    let rows = Fresnel::ALL.into_iter().map(|tier| ModelRow {
        term: "fresnel".to_owned(),
        tier: tier.name().to_owned(),
        truth: "spectrum".to_owned(),
        cases: METALS.iter().map(|metal| case(tier, metal)).collect(),
        albedo_error_max: None,
        reciprocity_error_max: None,
    });
    rows.collect()
}

fn case(tier: Fresnel, metal: &crate::reference::spectral::Named) -> ModelCase {
    let (spectrum, numbers) = (metal.spectrum(), metal.metal());
    let term = Reflectance {
        tier,
        // As materials hold it.
        f0: numbers.f0.clamp(DVec3::ZERO, DVec3::ONE),
        metal: numbers,
    };
    let (mut squares, mut weights, mut largest) = (DVec3::ZERO, 0.0, 0.0_f64);
    for i in 0..ANGLES {
        let theta = (f64::from(i) * 0.5).to_radians();
        let off = term.f(theta.cos()) - spectrum.reflectance(theta.cos());
        let weight = theta.cos() * theta.sin();
        squares += off * off * weight;
        weights += weight;
        largest = largest.max(off.abs().max_element());
    }
    ModelCase {
        surface: metal.name.to_owned(),
        error_rms: (squares / weights).max_element().sqrt(),
        error_max: largest,
        refitted_rms: None,
        truth_noise: 0.0,
    }
}
