//! What does a cost report say in sentences?

use super::cost::{CostReport, TierRow, ratio};
use super::cost_plots::anchor;

/// A sentence, and the row that it stands on.
pub struct Headline {
    /// It.
    pub text: String,
    /// The row's anchor on the page.
    pub row: String,
}

/// The model that frames have if nothing else is said.
const DEFAULT: &str = "eon + ggx-multi + spectral";
/// The slides' models by reduced algebra.
const CORRECTED: &str = "qon + cook-torrance + schlick";

/// All that the rows are enough for.
pub fn headlines(report: &CostReport) -> Vec<Headline> {
    let model = |name: &str| report.of_term("model").find(|row| row.tier == name);
    let (corrected, default, slides) = (model(CORRECTED), model(DEFAULT), model("slides"));
    let mut all: Vec<Headline> = Vec::new();
    all.extend(corrected.and_then(|row| {
        let text = format!(
            "The slides' models, rightly normalised and without their trigonometry, take {} of the listings' time.",
            of_slides(row)?
        );
        Some(said(row, text))
    }));
    all.extend(default.and_then(|row| {
        let text = format!(
            "The default model, {DEFAULT}, which loses no light between facets and has metals' colours at every angle, takes {}.",
            of_slides(row)?
        );
        Some(said(row, text))
    }));
    all.extend(slides.zip(default).and_then(|(slides, default)| {
        let text = format!(
            "In the scene where each looks worst, a person sees a mean difference of {:.3} (FLIP) by the listings, {:.4} by the default model.",
            slides.flip_mean?, default.flip_mean?
        );
        Some(said(slides, text))
    }));
    for (term, what) in [
        ("diffuse", "matte base"),
        ("specular", "facets"),
        ("fresnel", "Fresnel term"),
    ] {
        all.extend(of_term(report, term, what));
    }
    all.extend(of_promises(report));
    all
}

fn said(row: &TierRow, text: String) -> Headline {
    Headline {
        text,
        row: anchor(row),
    }
}

/// None where it was not measured.
fn of_slides(row: &TierRow) -> Option<String> {
    let measured = row.of_slides.filter(|ratio| ratio.is_finite())?;
    Some(ratio(Some(measured), &row.of_slides_95))
}

/// The nearest tier of a term, and what is beaten.
fn of_term(report: &CostReport, term: &str, what: &str) -> Option<Headline> {
    let error = |row: &&TierRow| row.model_error_rms.unwrap_or(f64::INFINITY);
    let nearest = report
        .of_term(term)
        .min_by(|a, b| error(a).total_cmp(&error(b)))?;
    let beaten = report.of_term(term).filter(|row| !row.pareto);
    let beaten: Vec<&str> = beaten.map(|row| row.tier.as_str()).collect();
    let rest = match beaten[..] {
        [] => "no tier is beaten in error and time by another".to_owned(),
        _ => format!("beaten in error and time: {}", beaten.join(", ")),
    };
    let text = format!(
        "Nearest {what}: {}, {:.2} % off at {} of the listings' time; {rest}.",
        nearest.tier,
        nearest.model_error_rms? * 100.0,
        of_slides(nearest)?
    );
    Some(said(nearest, text))
}

fn of_promises(report: &CostReport) -> Option<Headline> {
    let kept = report.promises.iter().filter(|row| row.chosen.is_some());
    let (count, kept) = (report.promises.len(), kept.count());
    let row = report.of_term("model").find(|row| row.tier == DEFAULT)?;
    (count > 0).then(|| {
        let text = format!(
            "Of {count} promises (a largest mean of FLIP, scene by scene) {kept} could be kept, each by the cheapest model found; the rest are refused."
        );
        said(row, text)
    })
}
