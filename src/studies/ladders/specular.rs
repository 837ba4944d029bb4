//! How far are the lobes of facets from the Smith microsurface of their slopes?

use glam::DVec3;

use super::SEED;
use super::fit::{distance, noise};
use crate::math::frame::spherical;
use crate::math::quadrature::{GaussLegendre, half_vectors};
use crate::reference::ggx_missing::{GgxMissing, albedo};
use crate::reference::ladders::{Fresnel, Specular};
use crate::reference::reflectance::Reflectance;
use crate::reference::spectral::METALS;
use crate::reference::truth::microsurface::{Facets, Microsurface, Slopes, truth};
use crate::reference::truth::{GLOSSY, Truth};
use crate::reference::{beckmann_smith, blinn_phong, cook_torrance, ggx, kulla_conty, slides};
use crate::report::{ModelCase, ModelRow};
use crate::studies::Cache;

/// Widths of the slopes.
const ALPHAS: [f64; 3] = [0.25, 0.5, 1.0];

/// The width at which metal facets are tried: the more bounces, the more the colour counts.
const METAL_ALPHA: f64 = 1.0;

/// Truths that are needed.
pub const TRUTHS: u64 = 2 * ALPHAS.len() as u64 + 1;

/// A row for each tier.
pub fn rows(cache: &Cache, paths: usize, progress: &(dyn Fn(u64) + Sync)) -> Vec<ModelRow> {
    let of = |slopes, name: &str| {
        ALPHAS.map(|alpha| {
            let parameters = format!("alpha {alpha}, mirrors, {paths} paths, seed {SEED}");
            cache.get(
                &format!("smith-{name}-{alpha}-{paths}"),
                &parameters,
                || {
                    let surface = Microsurface {
                        slopes,
                        alpha,
                        facets: Facets::Mirror,
                    };
                    truth(&GLOSSY, surface, None, (paths, SEED), &|| progress(1))
                },
            )
        })
    };
    let (ggx, beckmann) = (of(Slopes::Ggx, "ggx"), of(Slopes::Beckmann, "beckmann"));
    let gold = gold(cache, paths, progress);
    let row = |tier| match tier {
        Specular::Ggx | Specular::GgxMulti => {
            let mut row = row(tier, &ggx, "Smith walk, GGX");
            row.cases.extend(gold_cases(tier, &gold));
            row
        }
        _ => row(tier, &beckmann, "Smith walk, Beckmann"),
    };
    Specular::ALL.into_iter().map(row).collect()
}

/// Gold by Fresnel's equations at the wavelengths that stand for the channels.
fn gold_term() -> Reflectance {
    let metal = METALS[0].metal();
    Reflectance {
        tier: Fresnel::Conductor,
        f0: metal.f0,
        metal,
    }
}

fn gold(cache: &Cache, paths: usize, progress: &(dyn Fn(u64) + Sync)) -> Truth {
    let metal = gold_term().metal;
    let parameters = format!("alpha {METAL_ALPHA}, gold, {paths} paths, seed {SEED}");
    let name = format!("smith-gold-{METAL_ALPHA}-{paths}");
    cache.get(&name, &parameters, || {
        let surface = Microsurface {
            slopes: Slopes::Ggx,
            alpha: METAL_ALPHA,
            facets: Facets::Conductor([0, 1, 2].map(|i| (metal.n[i], metal.k[i]))),
        };
        truth(&GLOSSY, surface, None, (paths, SEED), &|| progress(1))
    })
}

fn gold_cases(tier: Specular, truth: &Truth) -> Vec<ModelCase> {
    let term = gold_term();
    let mean = term.mean();
    let f = |l: DVec3, e: DVec3, channel: usize| {
        let mu = l.dot((l + e).normalize());
        let once = ggx::lobe(N, l, e, METAL_ALPHA) * term.f(mu)[channel];
        let more = match tier {
            Specular::GgxMulti => kulla_conty::lobe(N, l, e, METAL_ALPHA, mean)[channel],
            _ => 0.0,
        };
        (once + more) / l.z
    };
    let channels = ["red", "green", "blue"].into_iter().enumerate();
    let cases = channels.map(|(channel, name)| {
        let found = distance(&GLOSSY, truth, channel, |l, e| f(l, e, channel));
        ModelCase {
            surface: format!("alpha {METAL_ALPHA}, gold, {name}"),
            error_rms: found.rms,
            error_max: found.largest,
            refitted_rms: None,
            truth_noise: noise(&GLOSSY, truth, channel),
        }
    });
    cases.collect()
}

fn row(tier: Specular, truths: &[Truth], name: &str) -> ModelRow {
    let case = |(alpha, truth): (&f64, &Truth)| {
        let found = distance(&GLOSSY, truth, 0, |l, e| f(tier, l, e, *alpha));
        ModelCase {
            surface: format!("alpha {alpha}, F = 1"),
            error_rms: found.rms,
            error_max: found.largest,
            refitted_rms: None,
            truth_noise: noise(&GLOSSY, truth, 0),
        }
    };
    ModelRow {
        term: "specular".to_owned(),
        tier: tier.name().to_owned(),
        truth: name.to_owned(),
        cases: ALPHAS.iter().zip(truths).map(case).collect(),
        albedo_error_max: Some(albedo_error(tier)),
        reciprocity_error_max: Some(reciprocity_error(tier)),
    }
}

const N: DVec3 = DVec3::Z;

/// f for F = 1.
fn f(tier: Specular, l: DVec3, e: DVec3, alpha: f64) -> f64 {
    let lobe = match tier {
        Specular::BlinnPhong => blinn_phong::lobe(N, l, e, alpha),
        Specular::CookTorrance => cook_torrance::lobe(N, l, e, alpha, DVec3::ONE).x,
        Specular::BeckmannSmith => beckmann_smith::rational_lobe(N, l, e, alpha),
        Specular::BeckmannSmithExact => beckmann_smith::lobe(N, l, e, alpha),
        Specular::Ggx => ggx::lobe(N, l, e, alpha),
        Specular::GgxMulti => {
            ggx::lobe(N, l, e, alpha) + kulla_conty::lobe(N, l, e, alpha, DVec3::ONE).x
        }
        // Before light of illuminance over pi.
        Specular::Slides => {
            slides::cook_torrance::cook_torrance(N, l, e, alpha, 1.0) / std::f64::consts::PI
        }
    };
    lobe / l.z
}

/// Over widths of 0.1 to 1 and angles up to 85 degrees.
fn albedo_error(tier: Specular) -> f64 {
    let rule = GaussLegendre::new(16);
    let mut worst = 0.0_f64;
    for alpha in [0.1, 0.25, 0.4, 0.6, 0.8, 1.0] {
        for degrees in [0.0_f64, 30.0, 60.0, 75.0, 85.0] {
            let e = spherical(degrees.to_radians(), 0.0);
            let back = match tier {
                Specular::Ggx => albedo(e.z, alpha),
                Specular::GgxMulti => albedo(e.z, alpha) + GgxMissing::new(alpha).at(e.z),
                _ => half_vectors(&rule, N, e, alpha, |l| f(tier, l, e, alpha) * l.z),
            };
            worst = worst.max((back - 1.0).abs());
        }
    }
    worst
}

fn reciprocity_error(tier: Specular) -> f64 {
    let off = GLOSSY.cells().map(|(l, e)| {
        let (there, back) = (f(tier, l, e, 0.5), f(tier, e, l, 0.5));
        (back / there - 1.0).abs()
    });
    off.fold(0.0, f64::max)
}
