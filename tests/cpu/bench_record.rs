//! Are the benchmark's committed rows whole, and does the README quote them as they are?

use std::path::{Path, PathBuf};

use umber::render::state_changes::MODES;
use umber::report::{BenchReport, BenchRow, headlines, read_bench};

type Tested = Result<(), Box<dyn std::error::Error>>;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/record")
}

fn record(name: &str) -> Result<BenchReport, Box<dyn std::error::Error>> {
    let bytes = std::fs::read(folder().join(name))?;
    read_bench(&bytes).map_err(|error| format!("{name}: {error}").into())
}

/// Every record of the folder, with its name.
fn records() -> Result<Vec<(String, BenchReport)>, Box<dyn std::error::Error>> {
    let mut records = Vec::new();
    for entry in std::fs::read_dir(folder())? {
        let name = entry?.file_name().to_string_lossy().into_owned();
        // Other studies' have their own tests.
        let others = ["cost-", "stability-"];
        if !others.iter().any(|other| name.starts_with(other)) {
            records.push((name.clone(), record(&name)?));
        }
    }
    Ok(records)
}

#[test]
fn each_record_says_on_what_and_how_it_was_made() -> Tested {
    let records = records()?;
    assert!(records.len() >= 2, "lavapipe and SwiftShader");
    for (name, report) in records {
        assert!(!report.machine.processor.is_empty(), "{name}");
        assert_ne!(report.program.revision, "unknown", "{name}");
        assert_eq!(report.method.name, "submit", "{name}");
        assert!(report.method.rounds >= 10, "{name}");
        assert!(!headlines(&report).is_empty(), "{name}");
    }
    Ok(())
}

#[test]
fn each_row_has_its_base_and_its_figures() -> Tested {
    for (name, report) in records()? {
        for row in &report.rows {
            assert!(
                MODES.iter().any(|mode| mode.name == row.mode),
                "{name}: {row:?}"
            );
            if row.note.contains("unsupported") {
                continue;
            }
            assert!(
                row.submit_to_idle_ms.is_some() && row.relative.is_some(),
                "{name}: {row:?}"
            );
            let same = |other: &&BenchRow| {
                other.mode == row.base
                    && other.order == row.order
                    && other.scene == row.scene
                    && (other.materials, other.draws) == (row.materials, row.draws)
                    && other.pixels_per_draw == row.pixels_per_draw
            };
            assert!(
                report.rows.iter().any(|other| same(&other)),
                "{name}: no base: {row:?}"
            );
        }
    }
    Ok(())
}

/// The columns of the README's table: record and scene.
const COLUMNS: [(&str, &str); 5] = [
    ("lavapipe.json", "bare"),
    ("lavapipe.json", "tiny"),
    ("lavapipe.json", "zoo"),
    ("swiftshader.json", "tiny"),
    ("swiftshader.json", "zoo"),
];

#[test]
fn the_readme_quotes_the_records() -> Tested {
    let readme = std::fs::read_to_string(folder().join("../../README.md"))?;
    let mut quoted = 0;
    for line in readme.lines() {
        let cells: Vec<_> = line.trim_matches('|').split('|').map(str::trim).collect();
        let Some((mode, order)) = mode_and_order(cells[0]) else {
            continue;
        };
        assert_eq!(cells.len(), 1 + COLUMNS.len(), "{line}");
        for (cell, (name, scene)) in cells[1..].iter().zip(COLUMNS) {
            let report = record(name)?;
            let row = report.rows.iter().find(|row| {
                (row.mode.as_str(), row.order.as_str(), row.scene.as_str()) == (mode, order, scene)
                    && (row.materials, row.draws) == (64, 10_000)
            });
            assert_eq!(
                *cell,
                row.map_or("-".to_owned(), figure),
                "{name}, {scene}: {line}"
            );
        }
        quoted += 1;
    }
    assert!(quoted >= 10, "{quoted} lines of the table were found");
    Ok(())
}

/// `pipeline-per-material, sorted`; shuffled where nothing is said.
fn mode_and_order(cell: &str) -> Option<(&str, &str)> {
    let (mode, order) = cell.split_once(", ").unwrap_or((cell, "shuffled"));
    let known = MODES.iter().any(|known| known.name == mode);
    (known && matches!(order, "sorted" | "shuffled")).then_some((mode, order))
}

/// `1.48 (1.45 to 1.57)`.
fn figure(row: &BenchRow) -> String {
    let bound = |bound: Option<f64>| bound.map_or("-".to_owned(), |bound| format!("{bound:.2}"));
    match (row.relative, row.relative_95) {
        (Some(relative), Some(interval)) => format!(
            "{relative:.2} ({} to {})",
            bound(interval.low),
            bound(interval.high)
        ),
        _ => "-".to_owned(),
    }
}
