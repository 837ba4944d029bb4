//! How far are the matte bases from Oren and Nayar's V-cavities?

use std::f64::consts::PI;

use glam::DVec3;

use super::SEED;
use super::fit::{Distance, Model, distance, noise, refitted};
use crate::math::frame::spherical;
use crate::math::quadrature::{GaussLegendre, hemisphere};
use crate::reference::ladders::Diffuse;
use crate::reference::truth::v_cavities::{ALBEDOS, truth};
use crate::reference::truth::{MATTE, Truth};
use crate::reference::{eon, fujii, full_oren_nayar, lambert, oren_nayar};
use crate::report::{ModelCase, ModelRow};
use crate::studies::Cache;

/// Surfaces, sigma in radians: from where the models differ by more than the truth's noise.
const SIGMAS: [f64; 3] = [0.35, 0.52, 0.8];

/// Truths that are needed.
pub const TRUTHS: u64 = SIGMAS.len() as u64;

/// A row for each tier.
pub fn rows(cache: &Cache, paths: usize, progress: &(dyn Fn(u64) + Sync)) -> Vec<ModelRow> {
    let truths = SIGMAS.map(|sigma| {
        let name = format!("v-cavities-{sigma}-{paths}");
        let parameters = format!("sigma {sigma}, {paths} paths, seed {SEED}");
        let make = || truth(&MATTE, sigma, paths, SEED, &|| progress(1));
        cache.get(&name, &parameters, make)
    });
    Diffuse::ALL
        .into_iter()
        .map(|tier| row(tier, &truths))
        .collect()
}

fn row(tier: Diffuse, truths: &[Truth]) -> ModelRow {
    let pairs = SIGMAS.iter().zip(truths);
    let cases = pairs.flat_map(|(sigma, truth)| {
        let channels = ALBEDOS.into_iter().enumerate();
        channels.map(move |(channel, albedo)| case(tier, truth, channel, (*sigma, albedo)))
    });
    ModelRow {
        term: "diffuse".to_owned(),
        tier: tier.name().to_owned(),
        truth: "V-cavities".to_owned(),
        cases: cases.collect(),
        albedo_error_max: Some(albedo_error(tier)),
        reciprocity_error_max: Some(reciprocity_error(tier)),
    }
}

fn case(tier: Diffuse, truth: &Truth, channel: usize, (sigma, albedo): (f64, f64)) -> ModelCase {
    let model = model(tier);
    let Distance { rms, largest } = match tier {
        // Their roughness is no angle: the best that there is, at the albedo as it is.
        Diffuse::Fon | Diffuse::Eon => best_roughness(model, truth, channel, albedo),
        _ => distance(&MATTE, truth, channel, |l, e| model(l, e, sigma, albedo)),
    };
    // Beyond 1 eon's sum of bounces has no limit.
    let most = if tier == Diffuse::Eon { 1.0 } else { 2.0 };
    let free = refitted(&MATTE, truth, channel, model, (sigma, albedo), most);
    ModelCase {
        surface: format!("sigma {sigma}, albedo {albedo}"),
        error_rms: rms,
        error_max: largest,
        refitted_rms: Some(free.rms),
        truth_noise: noise(&MATTE, truth, channel),
    }
}

fn best_roughness(model: Model, truth: &Truth, channel: usize, albedo: f64) -> Distance {
    let at = |r: f64| distance(&MATTE, truth, channel, |l, e| model(l, e, r, albedo));
    let tried = (0..=150).map(|i| at(f64::from(i) / 100.0));
    let best = tried.min_by(|a, b| a.rms.total_cmp(&b.rms));
    best.unwrap_or_else(|| at(0.0))
}

const N: DVec3 = DVec3::Z;

/// f of a tier: its lobe over pi and the light's cosine.
fn model(tier: Diffuse) -> Model {
    match tier {
        Diffuse::Lambert => |l, _, _, rho| rho * lambert::lobe(N, l) / (PI * l.z),
        // The listing is the same model where it is defined.
        Diffuse::Slides => |l, e, r, rho| rho * oren_nayar::lobe(N, l, e, r) / (PI * l.z),
        Diffuse::Qon => |l, e, r, rho| rho * oren_nayar::conserving_lobe(N, l, e, r) / (PI * l.z),
        Diffuse::Fon => |l, e, r, rho| rho * fujii::lobe(N, l, e, r) / (PI * l.z),
        Diffuse::Eon => |l, e, r, rho| eon::lobe(N, l, e, r, rho) / (PI * l.z),
        Diffuse::FullOrenNayar => {
            |l, e, r, rho| full_oren_nayar::lobe(N, l, e, r, rho) / (PI * l.z)
        }
    }
}

/// Over roughness 0 to 1 and angles up to 89 degrees.
fn albedo_error(tier: Diffuse) -> f64 {
    let (model, rule) = (model(tier), GaussLegendre::new(16));
    let mut worst = 0.0_f64;
    for roughness in (0..=20).map(|i| f64::from(i) / 20.0) {
        for degrees in [0.0_f64, 30.0, 60.0, 75.0, 85.0, 89.0] {
            let e = spherical(degrees.to_radians(), 0.4);
            let back = hemisphere(&rule, N, e, |l| model(l, e, roughness, 1.0) * l.z);
            worst = worst.max((back - 1.0).abs());
        }
    }
    worst
}

fn reciprocity_error(tier: Diffuse) -> f64 {
    let model = model(tier);
    let off = MATTE.cells().map(|(l, e)| {
        let (there, back) = (model(l, e, 0.6, 0.8), model(e, l, 0.6, 0.8));
        (back / there - 1.0).abs()
    });
    off.fold(0.0, f64::max)
}
