//! How does what was measured become rows?

use std::collections::BTreeMap;
use std::sync::Arc;

use super::Measured;
use super::evaluations::Evaluation;
use super::forms::{Form, TERMS};
use super::fragments::Fragment;
use super::gallery::Exhibit;
use super::instructions::instructions;
use super::pareto::{Point, front};
use super::sheet::Shown;
use crate::gpu::{Device, Error};
use crate::reference::ladders::{Diffuse, Fresnel, Specular};
use crate::reference::shade::Lighting;
use crate::render::library::{Function, Tier, name_of_diffuse, name_of_fresnel, name_of_specular};
use crate::report::{CostMethod, Interval95, LampRow, ModelRow, PromiseRow, SceneCost, TierRow};
use crate::studies::stability::{Amount, CASES, Study};

/// What the study found.
pub struct Found {
    /// Tiers and models.
    pub rows: Vec<TierRow>,
    /// Fragments as lamps grow.
    pub lamps: Vec<LampRow>,
    /// What was chosen.
    pub promises: Vec<PromiseRow>,
    /// Pictures for people.
    pub shown: Vec<Shown>,
    /// How.
    pub method: CostMethod,
}

/// Values behind a rounding error.
const JUDGED: usize = 4096;

/// A row for each form.
///
/// # Errors
/// There is no memory, or the driver fails.
pub(super) fn rows(
    device: &Arc<Device>,
    measured: &Measured,
    exhibits: &[Exhibit],
    errors: &[ModelRow],
) -> Result<Vec<TierRow>, Error> {
    let lightings: Vec<Lighting> = measured.forms.iter().map(|form| form.lighting).collect();
    // Tiers and models are not each other's rivals.
    let tiers = measured.forms.iter().filter(|form| form.term != "model");
    let (of_tiers, of_models) = lightings.split_at(tiers.count());
    let scenes = exhibits.iter().map(|exhibit| {
        let tiers = exhibit.rows(of_tiers).into_iter().map(untimed);
        tiers.chain(exhibit.rows(of_models)).collect::<Vec<_>>()
    });
    let scenes: Vec<_> = scenes.collect();
    let variants: Vec<_> = measured.forms.iter().map(|form| form.variant).collect();
    let instructions = instructions(&variants);
    let mut rows = Vec::new();
    for (i, form) in measured.forms.iter().enumerate() {
        let seen = scenes.iter().filter_map(|rows| rows[i].clone());
        let mut row = row(form, seen.collect());
        timed(
            &mut row,
            &measured.evaluations[i],
            measured.fragments.get(i),
        );
        row.spirv_instructions = instructions.get(i).copied().flatten();
        match errors
            .iter()
            .find(|row| row.term == form.term && row.tier == form.tier)
        {
            Some(known) => known_errors(&mut row, known),
            None => row.model_error_rms = radiance_error(exhibits, form.lighting),
        }
        row.rounding_error_max = rounding_error(device, form)?;
        rows.push(row);
    }
    for term in TERMS {
        mark_front(&mut rows, term);
    }
    Ok(rows)
}

/// A tier's frame is the frame of a model, and has its place there.
fn untimed(row: Option<SceneCost>) -> Option<SceneCost> {
    row.map(|row| SceneCost {
        frame_ms: None,
        of_default: None,
        of_default_95: Interval95::UNBOUNDED,
        pareto: false,
        ..row
    })
}

fn row(form: &Form, scenes: Vec<SceneCost>) -> TierRow {
    let worst = scenes
        .iter()
        .max_by(|a, b| a.flip_mean.total_cmp(&b.flip_mean));
    TierRow {
        term: form.term.to_owned(),
        tier: form.tier.clone(),
        model_error_rms: None,
        model_error_max: None,
        rounding_error_max: None,
        albedo_error_max: None,
        reciprocity_error_max: None,
        flip_mean: worst.map(|scene| scene.flip_mean),
        flip_p95: worst.map(|scene| scene.flip_p95),
        code_max: scenes.iter().map(|scene| scene.code_max).reduce(f64::max),
        ns_per_evaluation: None,
        ns_mad: None,
        of_slides: None,
        of_slides_95: Interval95::UNBOUNDED,
        ns_per_fragment: None,
        fragment_of_slides: None,
        fragment_of_slides_95: Interval95::UNBOUNDED,
        spirv_instructions: None,
        driver_statistics: BTreeMap::new(),
        pareto: false,
        scenes,
    }
}

fn timed(row: &mut TierRow, evaluation: &Evaluation, fragment: Option<&Fragment>) {
    row.ns_per_evaluation = Some(evaluation.ns);
    row.ns_mad = Some(evaluation.ns_mad);
    row.of_slides = Some(evaluation.of_slides.estimate);
    row.of_slides_95 = evaluation.of_slides.into();
    let statistics = evaluation.statistics.iter();
    let named = statistics.map(|told| (format!("{}: {}", told.executable, told.name), told.value));
    row.driver_statistics = named.collect();
    if let Some(fragment) = fragment {
        row.ns_per_fragment = Some(fragment.ns);
        row.fragment_of_slides = Some(fragment.of_slides.estimate);
        row.fragment_of_slides_95 = fragment.of_slides.into();
    }
}

fn known_errors(row: &mut TierRow, known: &ModelRow) {
    let cases = known.cases.iter();
    let squares: f64 = cases.clone().map(|case| case.error_rms.powi(2)).sum();
    row.model_error_rms = Some((squares / known.cases.len() as f64).sqrt());
    row.model_error_max = cases.map(|case| case.error_max).reduce(f64::max);
    row.albedo_error_max = known.albedo_error_max;
    row.reciprocity_error_max = known.reciprocity_error_max;
}

fn radiance_error(exhibits: &[Exhibit], lighting: Lighting) -> Option<f64> {
    let seen = exhibits.iter().filter_map(|exhibit| exhibit.seen(lighting));
    seen.map(|look| look.radiance_error).reduce(f64::max)
}

/// Against the twin in f64, where an accuracy is promised.
fn rounding_error(device: &Arc<Device>, form: &Form) -> Result<Option<f64>, Error> {
    let Some(function) = function(form).and_then(|name| Function::of_name(name).ok()) else {
        return Ok(None);
    };
    let amount = Amount {
        case: JUDGED,
        chance: 0,
        worst: 0,
        seed: 1,
    };
    let study = Study::new(device, function, Tier::F32, amount)?;
    let row = study.case(&CASES[0], &|_| {})?;
    Ok(row.max_relative_error)
}

fn function(form: &Form) -> Option<&'static str> {
    let named = |name: &str| name == form.tier;
    match form.term {
        "diffuse" => Diffuse::ALL
            .into_iter()
            .find(|tier| named(tier.name()))
            .map(name_of_diffuse),
        "specular" => Specular::ALL
            .into_iter()
            .find(|tier| named(tier.name()))
            .map(name_of_specular),
        "fresnel" => Fresnel::ALL
            .into_iter()
            .find(|tier| named(tier.name()))
            .map(name_of_fresnel),
        _ => None,
    }
}

fn mark_front(rows: &mut [TierRow], term: &str) {
    let mut own: Vec<&mut TierRow> = rows.iter_mut().filter(|row| row.term == term).collect();
    let points = own.iter().map(|row| Point {
        time: row.of_slides.unwrap_or(f64::NAN),
        error: match term {
            "model" => row.flip_mean.unwrap_or(f64::NAN),
            _ => row.model_error_rms.unwrap_or(f64::NAN),
        },
    });
    let on = front(&points.collect::<Vec<_>>());
    for (row, on) in own.iter_mut().zip(on) {
        row.pareto = on;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_tier_has_a_function() {
        for form in super::super::forms::tiers() {
            let name = function(&form).unwrap_or_default();
            assert!(Function::of_name(name).is_ok(), "{form:?}");
        }
    }
}
