//! Are the committed rows of `umber cost` whole, and does the README quote them as they are?

use std::path::{Path, PathBuf};

use umber::report::{CostReport, Interval95, TierRow};

type Tested = Result<(), Box<dyn std::error::Error>>;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/record")
}

fn record() -> Result<CostReport, Box<dyn std::error::Error>> {
    let bytes = std::fs::read(folder().join("cost-lavapipe.json"))?;
    Ok(serde_json::from_slice(&bytes)?)
}

#[test]
fn the_record_says_on_what_and_how_it_was_made() -> Tested {
    let report = record()?;
    assert_eq!(report.schema, CostReport::SCHEMA);
    assert!(!report.machine.processor.is_empty());
    assert_ne!(report.program.revision, "unknown");
    assert_eq!(report.method.plan, "full");
    assert!(report.method.rounds >= 6, "fewer have no interval");
    // All mixes, and the slides' own.
    assert_eq!(report.of_term("model").count(), 223);
    for row in &report.rows {
        let figures = [
            row.ns_per_evaluation,
            row.of_slides,
            row.ns_per_fragment,
            row.flip_mean,
            row.model_error_rms,
        ];
        assert!(figures.iter().all(Option::is_some), "{row:?}");
        assert!(row.spirv_instructions.is_some(), "{row:?}");
        assert_eq!(row.scenes.len(), 3, "{row:?}");
    }
    Ok(())
}

#[test]
fn every_promise_of_the_record_was_kept_or_refused() -> Tested {
    let report = record()?;
    assert!(report.promises.len() >= 12);
    for promise in &report.promises {
        let kept = promise.flip_mean <= promise.max_error;
        assert_eq!(kept, promise.chosen.is_some(), "{promise:?}");
        // Never slower than the default model, as far as frames can tell.
        let low = promise.of_default_95.low.unwrap_or(0.0);
        assert!(low <= 1.0, "{promise:?}");
    }
    Ok(())
}

#[test]
fn the_readme_quotes_the_record() -> Tested {
    let readme = std::fs::read_to_string(folder().join("../../README.md"))?;
    let report = record()?;
    let mut quoted = 0;
    for line in readme.lines() {
        let cells: Vec<_> = line.trim_matches('|').split('|').map(str::trim).collect();
        let Some((term, tier)) = cells[0].split_once(": ") else {
            continue;
        };
        let Some(row) = report
            .rows
            .iter()
            .find(|row| row.term == term && row.tier == tier)
        else {
            continue;
        };
        assert_eq!(cells[1..], figures(row), "{line}");
        quoted += 1;
    }
    assert!(quoted >= 22, "{quoted} lines of the table were found");
    Ok(())
}

fn figures(row: &TierRow) -> [String; 5] {
    let percent = row.model_error_rms.unwrap_or(f64::NAN) * 100.0;
    [
        if percent < 1.0 {
            format!("{percent:.2}")
        } else {
            format!("{percent:.1}")
        },
        format!("{:.4}", row.flip_mean.unwrap_or(f64::NAN)),
        ratio(row.of_slides, &row.of_slides_95),
        ratio(row.fragment_of_slides, &row.fragment_of_slides_95),
        row.spirv_instructions
            .map_or("-".to_owned(), |n| n.to_string()),
    ]
}

/// `0.55 (0.53 to 0.57)`.
fn ratio(ratio: Option<f64>, bounds: &Interval95) -> String {
    let figure = |x: Option<f64>| x.map_or("-".to_owned(), |x| format!("{x:.2}"));
    format!(
        "{} ({} to {})",
        figure(ratio),
        figure(bounds.low),
        figure(bounds.high)
    )
}
