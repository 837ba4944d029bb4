//! What does a stability report say in sentences?

use super::bench_words::{count, thousands};
use super::interval::Interval95;
use super::stability::{CostRow, StabilityReport, Summary, is_listing};

/// A sentence.
pub struct Headline {
    /// It, with its full stop.
    pub text: String,
    /// The row of the report that it stands on.
    pub row: usize,
}

/// Of the library, of each listing, and of what the safe forms cost beside the listings.
pub fn headlines(report: &StabilityReport) -> Vec<Headline> {
    let (listings, library): (Vec<Summary>, Vec<Summary>) = report
        .summaries()
        .into_iter()
        .partition(|summary| is_listing(&summary.function));
    let mut all: Vec<Headline> = of_library(&library).into_iter().collect();
    all.extend(listings.iter().map(of_listing));
    all.extend(library.iter().filter_map(|s| of_cost(s, &report.costs)));
    all
}

fn of_library(library: &[Summary]) -> Option<Headline> {
    let share = |summary: &Summary| summary.of_bound.unwrap_or(0.0);
    let nearest = library
        .iter()
        .max_by(|a, b| share(a).total_cmp(&share(b)))?;
    let bad = library.iter().find(|summary| summary.bad() > 0);
    let sum = |of: fn(&Summary) -> u64| library.iter().map(of).sum::<u64>();
    let functions = library.chunk_by(|a, b| a.function == b.function).count();
    let mut text = format!(
        "The library, {}: {} {}",
        count(functions as u64, "function"),
        kinds(sum(|s| s.nan), sum(|s| s.inf), sum(|s| s.negative)),
        count(sum(|s| s.inputs), "value"),
    );
    let (function, tier) = (&nearest.function, &nearest.tier);
    match nearest.of_bound {
        Some(share) if share > 1.0 => {
            text += &format!("; {function} in {tier} passes its bound: {share:.3} of it");
        }
        Some(share) => {
            let percent = share * 100.0;
            text += &format!(
                "; the nearest to its bound, {function} in {tier}, comes to {percent:.0} % of it"
            );
        }
        None => {}
    }
    Some(Headline {
        text: text + ".",
        row: bad.unwrap_or(nearest).row,
    })
}

/// `no NaN, infinity or negative value in`, or how many of each.
fn kinds(nan: u64, inf: u64, negative: u64) -> String {
    match nan + inf + negative {
        0 => "no NaN, infinity or negative value in".to_owned(),
        _ => format!(
            "{} NaN, {} infinite and {} negative of",
            thousands(nan),
            thousands(inf),
            thousands(negative)
        ),
    }
}

fn of_listing(summary: &Summary) -> Headline {
    let Summary {
        nan, inf, negative, ..
    } = *summary;
    let mut text = format!(
        "{}, {}: {} {}",
        summary.function,
        summary.tier,
        kinds(nan, inf, negative),
        count(summary.inputs, "value"),
    );
    if let Some(error) = summary.max_relative_error {
        text += &format!("; off by {error:.1e} of its own formula at most");
    }
    Headline {
        text: text + ".",
        row: summary.row,
    }
}

/// What a form costs beside its listing. Operations of 16 bits are made of those of 32, so their time means nothing.
fn of_cost(summary: &Summary, costs: &[CostRow]) -> Option<Headline> {
    let form = |cost: &&CostRow| (&cost.function, &cost.tier) == (&summary.function, &summary.tier);
    let cost = costs.iter().find(form).filter(|cost| cost.tier != "f16")?;
    let Interval95 {
        low: Some(low),
        high: Some(high),
    } = cost.relative_95
    else {
        return None;
    };
    let text = format!(
        "{} in {} costs {:.2} ({low:.2} to {high:.2}) of {}.",
        cost.function, cost.tier, cost.relative, cost.listing
    );
    Some(Headline {
        text,
        row: summary.row,
    })
}
