//! How do the rows of `umber bench` come into a spreadsheet?

use super::bench::{BenchReport, BenchRow};
use super::interval::Interval95;

/// The rows as CSV: names in the first line, then a line for each row. An interval is two columns; a figure that
/// is null is an empty cell.
pub fn csv(report: &BenchReport) -> Result<Vec<u8>, csv::Error> {
    if report.rows.is_empty() {
        return names();
    }
    lines(report.rows.iter().map(Line::from))
}

/// The writer takes the names from its first line: without rows, from one that is then cut off.
fn names() -> Result<Vec<u8>, csv::Error> {
    let mut bytes = lines(std::iter::once(Line::default()))?;
    let end = bytes.iter().position(|byte| *byte == b'\n');
    bytes.truncate(end.map_or(0, |end| end + 1));
    Ok(bytes)
}

fn lines<'r>(lines: impl Iterator<Item = Line<'r>>) -> Result<Vec<u8>, csv::Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for line in lines {
        writer.serialize(line)?;
    }
    let bytes = writer.into_inner();
    bytes.map_err(|error| csv::Error::from(error.into_error()))
}

/// A row, flat: the crate writes no struct within a struct.
#[derive(Default, serde::Serialize)]
struct Line<'r> {
    mode: &'r str,
    order: &'r str,
    scene: &'r str,
    materials: u32,
    draws: u32,
    pixels_per_draw: f64,
    width: u32,
    height: u32,
    record_ns_per_draw: Option<f64>,
    record_mad: Option<f64>,
    submit_to_idle_ms: Option<f64>,
    submit_to_idle_mad: Option<f64>,
    gpu_ms: Option<f64>,
    gpu_mad: Option<f64>,
    samples: u32,
    devices: u32,
    draw_calls: u64,
    pipeline_binds: u64,
    descriptor_set_binds: u64,
    push_constants: u64,
    pipelines_created: u64,
    creation_cold_ms: Option<f64>,
    creation_warm_ms: Option<f64>,
    memory_bytes: u64,
    image_hash: Option<&'r str>,
    base: &'r str,
    relative: Option<f64>,
    relative_low: Option<f64>,
    relative_high: Option<f64>,
    record_relative: Option<f64>,
    record_relative_low: Option<f64>,
    record_relative_high: Option<f64>,
    note: &'r str,
}

impl<'r> From<&'r BenchRow> for Line<'r> {
    fn from(row: &'r BenchRow) -> Self {
        let nothing = Interval95 {
            low: None,
            high: None,
        };
        let relative = row.relative_95.unwrap_or(nothing);
        let recording = row.record_relative_95.unwrap_or(nothing);
        Self {
            mode: &row.mode,
            order: &row.order,
            scene: &row.scene,
            materials: row.materials,
            draws: row.draws,
            pixels_per_draw: row.pixels_per_draw,
            width: row.width,
            height: row.height,
            record_ns_per_draw: row.record_ns_per_draw,
            record_mad: row.record_mad,
            submit_to_idle_ms: row.submit_to_idle_ms,
            submit_to_idle_mad: row.submit_to_idle_mad,
            gpu_ms: row.gpu_ms,
            gpu_mad: row.gpu_mad,
            samples: row.samples,
            devices: row.devices,
            draw_calls: row.draw_calls,
            pipeline_binds: row.pipeline_binds,
            descriptor_set_binds: row.descriptor_set_binds,
            push_constants: row.push_constants,
            pipelines_created: row.pipelines_created,
            creation_cold_ms: row.creation_cold_ms,
            creation_warm_ms: row.creation_warm_ms,
            memory_bytes: row.memory_bytes,
            image_hash: row.image_hash.as_deref(),
            base: &row.base,
            relative: row.relative,
            relative_low: relative.low,
            relative_high: relative.high,
            record_relative: row.record_relative,
            record_relative_low: recording.low,
            record_relative_high: recording.high,
            note: &row.note,
        }
    }
}
