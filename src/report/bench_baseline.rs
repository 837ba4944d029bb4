//! Is a file an earlier report of `umber bench`? Nothing of it is used before all of it is checked.

use super::bench::{BenchReport, BenchRow};
use super::bench_words::plain;
use super::interval::Interval95;

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
const LONGEST_TEXT: usize = 10_000;

/// A file that is no such report: what is wrong, where, and what to do.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("{0}; give a report that `umber bench --json=FILE` of this version wrote")]
pub struct BadBaseline(String);

/// Only the name of the layout, which decides whether the rest is read.
#[derive(serde::Deserialize)]
struct Layout {
    schema: String,
}

/// Reads a report, and refuses what `umber bench` would not have written.
pub fn read(bytes: &[u8]) -> Result<BenchReport, BadBaseline> {
    let layout: Layout = serde_json::from_slice(bytes).map_err(|error| {
        let what = match error.is_data() {
            true => "no report of Umber",
            false => "no JSON",
        };
        BadBaseline(format!("{what}: {error}"))
    })?;
    if layout.schema != BenchReport::SCHEMA {
        let (found, wanted) = (shown(&layout.schema), BenchReport::SCHEMA);
        let message = format!("its schema is {found} and not \"{wanted}\"");
        return Err(BadBaseline(message));
    }
    let report: BenchReport = serde_json::from_slice(bytes)
        .map_err(|error| BadBaseline(format!("not all of a report: {error}")))?;
    check(&report).map_err(BadBaseline)?;
    Ok(report)
}

fn check(report: &BenchReport) -> Result<(), String> {
    let (device, machine) = (&report.device, &report.machine);
    let (method, program) = (&report.method, &report.program);
    let texts = [
        ("device.name", &device.name),
        ("device.type", &device.kind),
        ("device.driver", &device.driver),
        ("device.driver_version", &device.driver_version),
        ("device.api", &device.api),
        ("device.uuid", &device.uuid),
        ("machine.processor", &machine.processor),
        ("machine.system", &machine.system),
        ("method.name", &method.name),
        ("method.plan", &method.plan),
        ("method.heap", &method.heap),
        ("program.version", &program.version),
        ("program.revision", &program.revision),
        ("program.clock", &program.clock),
    ];
    for (name, text) in texts {
        check_text(name, text)?;
    }
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
        check_interval("pixels_95", even.pixels_95, MOST_PIXELS).map_err(of)?;
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
    check_interval("relative_95", row.relative_95, MOST_TIMES)?;
    check_interval("record_relative_95", row.record_relative_95, MOST_TIMES)
}

/// Names and notes are short, and go to terminals as they are.
fn check_text(name: &str, text: &str) -> Result<(), String> {
    if text.len() > LONGEST_TEXT {
        return Err(format!("{name} has {} bytes", text.len()));
    }
    match plain(text) == text {
        true => Ok(()),
        false => Err(format!("{name} has control characters: {}", shown(text))),
    }
}

fn check_count(name: &str, count: u64, most: u64) -> Result<(), String> {
    match count <= most {
        true => Ok(()),
        false => Err(format!("{name} is {count}, more than {most}")),
    }
}

fn check_figure(name: &str, figure: f64, most: f64) -> Result<(), String> {
    match (0.0..=most).contains(&figure) {
        true => Ok(()),
        false => Err(format!("{name} is {figure}, not between 0 and {most}")),
    }
}

fn check_interval(name: &str, interval: Option<Interval95>, most: f64) -> Result<(), String> {
    let Some(Interval95 { low, high }) = interval else {
        return Ok(());
    };
    check_figure(name, low.unwrap_or(0.0), most)?;
    check_figure(name, high.unwrap_or(0.0), most)?;
    match (low, high) {
        (Some(low), Some(high)) if low > high => {
            Err(format!("{name} runs from {low} down to {high}"))
        }
        _ => Ok(()),
    }
}

/// The beginning of a text, quoted, with its control characters spelled out.
fn shown(text: &str) -> String {
    let short: String = text.chars().take(40).collect();
    format!("{short:?}")
}
