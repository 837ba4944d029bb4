//! Do the committed rows of `umber stability` keep every promise, and does the README quote them as they are?

use std::path::{Path, PathBuf};

use umber::render::library::FUNCTIONS;
use umber::report::{CostRow, Interval95, StabilityReport, Summary, read_stability};

type Tested = Result<(), Box<dyn std::error::Error>>;

const DRIVERS: [&str; 2] = ["lavapipe", "swiftshader"];

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/record")
}

fn record(driver: &str) -> Result<StabilityReport, Box<dyn std::error::Error>> {
    let bytes = std::fs::read(folder().join(format!("stability-{driver}.json")))?;
    Ok(read_stability(&bytes)?)
}

/// The README without the commas that part thousands.
fn readme() -> std::io::Result<String> {
    Ok(std::fs::read_to_string(folder().join("../../README.md"))?.replace(',', ""))
}

fn is_listing(function: &str) -> bool {
    function.starts_with("slides-")
}

/// All functions of the library, each in each tier.
fn library(report: &StabilityReport) -> Vec<Summary> {
    let summaries = report.summaries();
    summaries
        .into_iter()
        .filter(|summary| !is_listing(&summary.function))
        .collect()
}

#[test]
fn each_record_says_on_what_and_how_it_was_made() -> Tested {
    for driver in DRIVERS {
        let report = record(driver)?;
        assert!(!report.machine.processor.is_empty());
        assert_ne!(report.program.revision, "unknown");
        assert_eq!(report.plan, "full");
    }
    Ok(())
}

/// Reports tell a listing by its name alone.
#[test]
fn the_listings_and_they_alone_are_named_so() {
    for function in FUNCTIONS {
        assert_eq!(
            function.is_listing,
            is_listing(function.name),
            "{}",
            function.name
        );
    }
}

#[test]
fn the_library_kept_its_promises_at_ten_thousand_million_inputs() -> Tested {
    for driver in DRIVERS {
        let library = library(&record(driver)?);
        let all = FUNCTIONS
            .iter()
            .filter(|function| !is_listing(function.name));
        for (function, tier) in all.flat_map(|f| f.tiers.iter().map(move |tier| (f, tier))) {
            let found = library
                .iter()
                .find(|s| (&*s.function, &*s.tier) == (function.name, tier.name()));
            let summary = found.ok_or_else(|| format!("{driver}: no {}", function.name))?;
            assert_eq!(
                (summary.nan, summary.inf, summary.negative),
                (0, 0, 0),
                "{driver}: {summary:?}"
            );
            assert!(
                summary.of_bound.is_some_and(|share| share <= 1.0),
                "{driver}: {summary:?}"
            );
            assert!(summary.inputs >= 100_000_000, "{driver}: {summary:?}");
        }
        let values: u64 = library.iter().map(|summary| summary.inputs).sum();
        assert!(values >= 10_000_000_000, "{driver}: {values}");
        let quoted = format!("{values} values of the library");
        assert!(readme()?.contains(&quoted), "{driver}: {quoted}");
    }
    Ok(())
}

#[test]
fn no_form_costs_more_than_it_may() -> Tested {
    let costs = record("lavapipe")?.costs;
    for (tier, most) in [("f32", 0.7), ("f32-compensated", 1.2)] {
        let of_tier: Vec<_> = costs.iter().filter(|cost| cost.tier == tier).collect();
        assert_eq!(of_tier.len(), 2, "{tier}");
        for cost in of_tier {
            assert!(cost.relative <= most, "{cost:?}");
        }
    }
    Ok(())
}

#[test]
fn the_readme_quotes_the_record() -> Tested {
    let readme = readme()?;
    let report = record("lavapipe")?;
    let values = format!("(lavapipe {} values", report.evaluations);
    assert!(readme.contains(&values), "{values}");
    for line in report.summaries().iter().map(line_of) {
        assert!(readme.lines().any(|other| other == line), "{line}");
    }
    let costs = report.costs.iter().filter(|cost| cost.tier != "f16");
    for line in costs.map(line_of_cost) {
        assert!(readme.lines().any(|other| other == line), "{line}");
    }
    Ok(())
}

#[test]
fn the_readme_quotes_what_the_second_driver_pays() -> Tested {
    let costs = record("swiftshader")?.costs;
    let cost = |function: &str, tier: &str| {
        let row = costs
            .iter()
            .find(|row| (&*row.function, &*row.tier) == (function, tier));
        row.map(|row| format!("{:.2}", row.relative))
            .ok_or("no such cost")
    };
    let quoted = format!(
        "cost {} and {} of the listing (Oren-Nayar) {} and {} (Cook-Torrance;",
        cost("oren-nayar", "f32")?,
        cost("oren-nayar", "f32-compensated")?,
        cost("cook-torrance", "f32")?,
        cost("cook-torrance", "f32-compensated")?,
    );
    let readme: Vec<_> = readme()?.split_whitespace().map(str::to_owned).collect();
    assert!(readme.join(" ").contains(&quoted), "{quoted}");
    Ok(())
}

fn line_of(summary: &Summary) -> String {
    let cells = [
        summary.function.clone(),
        summary.tier.replace(',', ""),
        summary.inputs.to_string(),
        format!("{} {} {}", summary.nan, summary.inf, summary.negative),
        format!("{:.1e}", summary.max_relative_error.unwrap_or(f64::NAN)),
        match summary.of_bound {
            Some(share) => format!("{:.0} %", share * 100.0),
            None => "nothing promised".to_owned(),
        },
        format!("{:.1}", summary.max_bits_lost.unwrap_or(f64::NAN)),
    ];
    format!("| {} |", cells.join(" | "))
}

fn line_of_cost(cost: &CostRow) -> String {
    let Interval95 { low, high } = cost.relative_95;
    format!(
        "| {} | {} | {:.2} | {:.2} | {:.2} ({:.2} to {:.2}) |",
        cost.function,
        cost.tier,
        cost.ns,
        cost.listing_ns,
        cost.relative,
        low.unwrap_or(f64::NAN),
        high.unwrap_or(f64::NAN),
    )
}
