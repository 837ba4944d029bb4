//! Do a benchmark's rows reach the reader as they are: in sentences, tables, files and plots?

mod baseline;
mod page;

use umber::report::{
    BenchReport, BenchRow, BreakEven, Device, Interval95, Machine, Method, Program, bench_csv,
    bench_table, headlines,
};

type Tested = Result<(), Box<dyn std::error::Error>>;

fn interval(low: f64, high: f64) -> Interval95 {
    Interval95 {
        low: Some(low),
        high: Some(high),
    }
}

/// A row of a mode whose ratio to its base is known within 4 %.
fn row(mode: &str, order: &str, scene: &str, relative: f64) -> BenchRow {
    BenchRow {
        mode: mode.to_owned(),
        order: order.to_owned(),
        scene: scene.to_owned(),
        materials: 64,
        draws: 10_000,
        pixels_per_draw: 8.0,
        width: 500,
        height: 500,
        record_ns_per_draw: Some(60.0),
        record_mad: Some(5.0),
        submit_to_idle_ms: Some(20.0 * relative),
        submit_to_idle_mad: Some(0.3),
        gpu_ms: Some(18.0 * relative),
        gpu_mad: Some(0.2),
        samples: 12,
        devices: 6,
        draw_calls: 10_000,
        pipeline_binds: 1,
        descriptor_set_binds: 1,
        push_constants: 0,
        pipelines_created: 1,
        creation_cold_ms: Some(80.0),
        creation_warm_ms: Some(25.0),
        memory_bytes: 4096,
        image_hash: Some("0123456789abcdef".to_owned()),
        base: "one-pipeline".to_owned(),
        relative: Some(relative),
        relative_95: Some(interval(relative * 0.98, relative * 1.02)),
        record_relative: Some(1.0),
        record_relative_95: Some(interval(0.9, 1.1)),
        note: String::new(),
    }
}

/// Rows of four scenes; one mode is not supported.
fn rows() -> Vec<BenchRow> {
    let mut switching = row("pipeline-per-material", "shuffled", "tiny", 5.1);
    switching.pipeline_binds = 9_843;
    let mut again = row("same-pipeline-again", "shuffled", "tiny", 5.0);
    again.pipeline_binds = 9_843;
    let mut unsupported = row("indirect", "shuffled", "tiny", 1.0);
    unsupported.note = "unsupported: multiDrawIndirect".to_owned();
    (unsupported.relative, unsupported.relative_95) = (None, None);
    (unsupported.submit_to_idle_ms, unsupported.gpu_ms) = (None, None);
    unsupported.samples = 0;
    let patch = |mode: &str, side: u32, relative| BenchRow {
        pixels_per_draw: f64::from(side * side),
        draws: 64,
        ..row(mode, "shuffled", "patches", relative)
    };
    vec![
        row("one-pipeline", "shuffled", "tiny", 1.0),
        switching,
        again,
        BenchRow {
            pipeline_binds: 64,
            relative_95: Some(interval(1.005, 1.03)),
            ..row("pipeline-per-material", "sorted", "tiny", 1.01)
        },
        unsupported,
        row("one-pipeline", "shuffled", "zoo", 1.0),
        row("pipeline-per-material", "shuffled", "zoo", 1.2),
        row("one-pipeline", "shuffled", "bare", 1.0),
        BenchRow {
            submit_to_idle_ms: Some(100.0),
            ..row("one-pipeline", "shuffled", "bare-storage", 1.0)
        },
        patch("one-pipeline", 8, 1.0),
        patch("pipeline-per-material", 8, 1.4),
        patch("one-pipeline", 64, 1.0),
        patch("pipeline-per-material", 64, 0.8),
    ]
}

/// A small report of a CPU.
fn report() -> BenchReport {
    BenchReport {
        schema: BenchReport::SCHEMA.to_owned(),
        device: Device {
            name: "llvmpipe (LLVM 15.0.6, 256 bits)".to_owned(),
            kind: "cpu".to_owned(),
            driver: "llvmpipe".to_owned(),
            driver_version: "Mesa 22.3.6".to_owned(),
            api: "1.3.230".to_owned(),
            uuid: "6d65".to_owned(),
        },
        machine: Machine {
            processor: "A processor".to_owned(),
            threads: Some(2),
            memory_bytes: Some(24 << 30),
            system: "linux 6.1".to_owned(),
        },
        method: Method {
            name: "submit".to_owned(),
            plan: "full".to_owned(),
            rounds: 12,
            further_seconds: 15.0,
            warm_up: 2,
            cell_seconds: 30.0,
            seed: 1,
            heap: String::new(),
        },
        rows: rows(),
        break_even: vec![BreakEven {
            single: "one-pipeline".to_owned(),
            materials: 64,
            pixels: Some(900.0),
            pixels_95: Some(interval(64.0, 4096.0)),
            note: String::new(),
        }],
        program: Program::this(),
    }
}

fn sentences(report: &BenchReport) -> Vec<String> {
    headlines(report)
        .into_iter()
        .map(|headline| headline.text)
        .collect()
}

#[test]
fn each_sentence_has_the_figure_of_its_row() {
    let report = report();
    let found = headlines(&report);
    let first = &found[0];
    assert_eq!(first.row, 1);
    assert!(
        first
            .text
            .starts_with("A pipeline switch before 98 % of the draws takes 5.1 (5.0 to 5.2) times"),
        "{}",
        first.text
    );
    for headline in &found {
        assert!(headline.text.ends_with('.') && headline.row < report.rows.len());
    }
    let all = sentences(&report).join("\n");
    // What binds the same again, what does not matter, what nobody reads, where it pays, whose times they are.
    for part in [
        "98 % of what the change adds",
        "Sorted by material, 64 pipeline switches add less than 5 %",
        "A storage buffer that no shader reads makes a frame of plain draws take 5.0 times as long",
        "from 900 (64.0 to 4,096) pixels a draw",
        "a CPU rasteriser's",
        "zoo",
    ] {
        assert!(all.contains(part), "no '{part}' in:\n{all}");
    }
    assert!(
        !all.contains("Indirect"),
        "an unsupported mode says nothing:\n{all}"
    );
}

#[test]
fn without_rows_there_is_nothing_to_say() {
    let empty = BenchReport {
        rows: Vec::new(),
        break_even: Vec::new(),
        ..report()
    };
    assert!(headlines(&empty).is_empty());
    assert!(!bench_table(&empty).is_empty());
}

#[test]
fn an_interval_that_holds_one_decides_nothing() {
    let mut report = report();
    report.rows[1].relative = Some(1.02);
    report.rows[1].relative_95 = Some(interval(0.97, 1.2));
    let first = &sentences(&report)[0];
    assert!(
        first.contains("no difference that 12 frames show"),
        "{first}"
    );
}

#[test]
fn a_data_centre_device_is_told_what_it_is_made_for() {
    let mut report = report();
    report.device.kind = "discrete".to_owned();
    report.device.name = "NVIDIA H100".to_owned();
    let all = sentences(&report).join("\n");
    assert!(all.contains("small part"), "{all}");
    assert!(!all.contains("CPU rasteriser"), "{all}");
}

#[test]
fn the_table_has_every_row_and_why_one_is_empty() {
    let report = report();
    let table = bench_table(&report);
    for row in &report.rows {
        assert!(table.contains(&row.mode), "{}:\n{table}", row.mode);
    }
    assert!(table.contains("unsupported: multiDrawIndirect"), "{table}");
    assert!(
        table.contains("510.0") && table.contains("[499.8, 520.2]"),
        "{table}"
    );
    for bad in ["NaN", "inf"] {
        assert!(!table.contains(bad), "{table}");
    }
}

#[test]
fn csv_has_what_json_has() -> Tested {
    let report = report();
    let bytes = bench_csv(&report)?;
    let mut reader = csv::Reader::from_reader(&bytes[..]);
    let names: Vec<_> = reader.headers()?.iter().map(str::to_owned).collect();
    let json = serde_json::to_value(&report.rows[0])?;
    let keys: Vec<_> = json
        .as_object()
        .into_iter()
        .flatten()
        .map(|(key, _)| key.clone())
        .collect();
    for key in &keys {
        let columns = match key.strip_suffix("_95") {
            Some(key) => vec![format!("{key}_low"), format!("{key}_high")],
            None => vec![key.clone()],
        };
        assert!(
            columns.iter().all(|column| names.contains(column)),
            "{key}: {names:?}"
        );
    }
    let records: Vec<_> = reader.records().collect::<Result<_, _>>()?;
    assert_eq!(records.len(), report.rows.len());
    let cell = |record: usize, name: &str| {
        let column = names.iter().position(|known| known == name);
        column
            .and_then(|column| records[record].get(column))
            .unwrap_or("absent")
            .to_owned()
    };
    assert_eq!(cell(1, "relative"), "5.1");
    assert_eq!(cell(4, "relative"), "");
    assert_eq!(cell(4, "note"), "unsupported: multiDrawIndirect");
    Ok(())
}

#[test]
fn a_row_has_the_keys_of_its_layout() -> Tested {
    let json = serde_json::to_value(report())?;
    assert_eq!(json["schema"], "umber.bench/1");
    for key in [
        "mode",
        "order",
        "scene",
        "materials",
        "draws",
        "record_ns_per_draw",
        "record_mad",
        "submit_to_idle_ms",
        "gpu_ms",
        "samples",
        "pipeline_binds",
        "descriptor_set_binds",
        "pipelines_created",
        "creation_cold_ms",
        "creation_warm_ms",
        "image_hash",
        "relative",
        "note",
    ] {
        assert!(json["rows"][0].get(key).is_some(), "{key}");
    }
    Ok(())
}
