//! Is a file an earlier report of `umber bench`?

use super::bench::{BenchReport, BenchRow};
use super::interval::Interval95;
use super::reading::{
    BadReport, check_count, check_figure, check_interval, check_made, check_text, of_schema,
};

/// Larger counts, sizes and times than these were not measured.
const MOST_ROWS: u64 = 100_000;
const MOST_MATERIALS: u64 = 1_000_000;
const MOST_DRAWS: u64 = 100_000_000;
const MOST_SIDE: u64 = 65_536;
const MOST_COMMANDS: u64 = 1_000_000_000_000;
const MOST_BYTES: u64 = 1 << 50;
const MOST_MS: f64 = 1.0e9;
const MOST_NS: f64 = 1.0e15;
const MOST_PIXELS: f64 = 1.0e12;
const MOST_TIMES: f64 = 1.0e9;

/// Reads a report, and refuses what `umber bench` would not have written.
pub fn read(bytes: &[u8]) -> Result<BenchReport, BadReport> {
    of_schema(bytes, BenchReport::SCHEMA, "umber bench", check)
}

fn check(report: &BenchReport) -> Result<(), String> {
    let method = &report.method;
    check_made(&report.device, &report.machine, &report.program)?;
    check_text("method.name", &method.name)?;
    check_text("method.plan", &method.plan)?;
    check_text("method.heap", &method.heap)?;
    let seconds = MOST_MS / 1000.0;
    check_figure("method.cell_seconds", method.cell_seconds, seconds)?;
    check_figure("method.further_seconds", method.further_seconds, seconds)?;
    let rows = (report.rows.len() + report.break_even.len()) as u64;
    check_count("the number of rows", rows, MOST_ROWS)?;
    for (i, row) in report.rows.iter().enumerate() {
        check_row(row).map_err(|what| format!("rows[{i}]: {what}"))?;
    }
    for (i, even) in report.break_even.iter().enumerate() {
        let of = |what| format!("break_even[{i}]: {what}");
        check_text("single", &even.single).map_err(of)?;
        check_text("note", &even.note).map_err(of)?;
        check_count("materials", even.materials.into(), MOST_MATERIALS).map_err(of)?;
        check_figure("pixels", even.pixels.unwrap_or(0.0), MOST_PIXELS).map_err(of)?;
        check_bounds("pixels_95", even.pixels_95, MOST_PIXELS).map_err(of)?;
    }
    Ok(())
}

fn check_row(row: &BenchRow) -> Result<(), String> {
    let hash = row.image_hash.as_deref().unwrap_or("");
    let texts = [
        ("mode", row.mode.as_str()),
        ("order", &row.order),
        ("scene", &row.scene),
        ("base", &row.base),
        ("note", &row.note),
        ("image_hash", hash),
    ];
    for (name, text) in texts {
        check_text(name, text)?;
    }
    let counts = [
        ("materials", row.materials.into(), MOST_MATERIALS),
        ("draws", row.draws.into(), MOST_DRAWS),
        ("width", row.width.into(), MOST_SIDE),
        ("height", row.height.into(), MOST_SIDE),
        ("samples", row.samples.into(), MOST_DRAWS),
        ("devices", row.devices.into(), MOST_DRAWS),
        ("draw_calls", row.draw_calls, MOST_COMMANDS),
        ("pipeline_binds", row.pipeline_binds, MOST_COMMANDS),
        (
            "descriptor_set_binds",
            row.descriptor_set_binds,
            MOST_COMMANDS,
        ),
        ("push_constants", row.push_constants, MOST_COMMANDS),
        ("pipelines_created", row.pipelines_created, MOST_COMMANDS),
        ("memory_bytes", row.memory_bytes, MOST_BYTES),
    ];
    for (name, count, most) in counts {
        check_count(name, count, most)?;
    }
    let figures = [
        ("pixels_per_draw", Some(row.pixels_per_draw), MOST_PIXELS),
        ("record_ns_per_draw", row.record_ns_per_draw, MOST_NS),
        ("record_mad", row.record_mad, MOST_NS),
        ("submit_to_idle_ms", row.submit_to_idle_ms, MOST_MS),
        ("submit_to_idle_mad", row.submit_to_idle_mad, MOST_MS),
        ("gpu_ms", row.gpu_ms, MOST_MS),
        ("gpu_mad", row.gpu_mad, MOST_MS),
        ("creation_cold_ms", row.creation_cold_ms, MOST_MS),
        ("creation_warm_ms", row.creation_warm_ms, MOST_MS),
        ("relative", row.relative, MOST_TIMES),
        ("record_relative", row.record_relative, MOST_TIMES),
    ];
    for (name, figure, most) in figures {
        check_figure(name, figure.unwrap_or(0.0), most)?;
    }
    check_bounds("relative_95", row.relative_95, MOST_TIMES)?;
    check_bounds("record_relative_95", row.record_relative_95, MOST_TIMES)
}

/// Bounds of at least 0, if there are any.
fn check_bounds(name: &str, interval: Option<Interval95>, most: f64) -> Result<(), String> {
    check_interval(name, interval.unwrap_or(Interval95::UNBOUNDED), 0.0..=most)
}
