//! Is a file an earlier report of `umber stability`?

use super::reading::{
    BadReport, check_count, check_figure, check_interval, check_made, check_text, check_within,
    of_schema,
};
use super::stability::{BitsMap, CostRow, StabilityReport, StabilityRow};

/// Larger counts and figures than these were not made. All rows' values together stay below 2^64.
const MOST_ROWS: u64 = 10_000;
const MOST_VALUES: u64 = 100_000_000_000_000;
const MOST_MAPS: u64 = 1_000;
const MOST_CELLS: u64 = 1_000;
const MOST_ERROR: f64 = 1.0e300;
const MOST_BITS: f64 = 2_000.0;
const MOST_NS: f64 = 1.0e15;
const MOST_TIMES: f64 = 1.0e9;
const MOST_DEGREES: f64 = 90.0;

/// Reads a report, and refuses what `umber stability` would not have written.
pub fn read(bytes: &[u8]) -> Result<StabilityReport, BadReport> {
    of_schema(bytes, StabilityReport::SCHEMA, "umber stability", check)
}

fn check(report: &StabilityReport) -> Result<(), String> {
    check_made(&report.device, &report.machine, &report.program)?;
    check_text("plan", &report.plan)?;
    check_count("the number of rows", report.rows.len() as u64, MOST_ROWS)?;
    check_count("the number of maps", report.maps.len() as u64, MOST_MAPS)?;
    check_count("the number of costs", report.costs.len() as u64, MOST_ROWS)?;
    for (i, row) in report.rows.iter().enumerate() {
        check_row(row).map_err(|what| format!("rows[{i}]: {what}"))?;
    }
    for (i, cost) in report.costs.iter().enumerate() {
        check_cost(cost).map_err(|what| format!("costs[{i}]: {what}"))?;
    }
    for (i, map) in report.maps.iter().enumerate() {
        check_map(map).map_err(|what| format!("maps[{i}]: {what}"))?;
    }
    let inputs: u64 = report.rows.iter().map(|row| row.inputs).sum();
    match report.evaluations == inputs {
        true => Ok(()),
        false => Err(format!(
            "evaluations is {}, and the rows' inputs together {inputs}",
            report.evaluations
        )),
    }
}

fn check_row(row: &StabilityRow) -> Result<(), String> {
    check_text("function", &row.function)?;
    check_text("tier", &row.tier)?;
    check_text("case", &row.case)?;
    check_text("worst_input", row.worst_input.as_deref().unwrap_or(""))?;
    check_count("inputs", row.inputs, MOST_VALUES)?;
    for (name, count) in [
        ("judged", row.judged),
        ("nan", row.nan),
        ("inf", row.inf),
        ("negative", row.negative),
    ] {
        check_count(name, count, row.inputs)?;
    }
    // A value is one of them at most.
    let bad = row.nan + row.inf + row.negative;
    check_count("nan, inf and negative together", bad, row.inputs)?;
    for (name, figure, most) in [
        ("max_relative_error", row.max_relative_error, MOST_ERROR),
        ("mean_relative_error", row.mean_relative_error, MOST_ERROR),
        ("max_of_bound", row.max_of_bound, MOST_ERROR),
        ("max_ulp", row.max_ulp, MOST_ERROR),
        ("max_bits_lost", row.max_bits_lost, MOST_BITS),
    ] {
        check_figure(name, figure.unwrap_or(0.0), most)?;
    }
    Ok(())
}

/// Net of what reading and writing take, a time may fall below 0.
fn check_cost(cost: &CostRow) -> Result<(), String> {
    check_text("function", &cost.function)?;
    check_text("tier", &cost.tier)?;
    check_text("listing", &cost.listing)?;
    let (times, ns) = (-MOST_TIMES..=MOST_TIMES, -MOST_NS..=MOST_NS);
    check_within("ns", cost.ns, ns.clone())?;
    check_within("listing_ns", cost.listing_ns, ns)?;
    check_within("relative", cost.relative, times.clone())?;
    check_interval("relative_95", cost.relative_95, times)
}

/// A map has a cell for each roughness and angle.
fn check_map(map: &BitsMap) -> Result<(), String> {
    check_text("function", &map.function)?;
    check_text("tier", &map.tier)?;
    let (wide, high) = (map.roughness.len(), map.degrees.len());
    check_count("the number of columns", wide as u64, MOST_CELLS)?;
    check_count("the number of rows", high as u64, MOST_CELLS)?;
    let even =
        map.bits.iter().all(|row| row.len() == wide) && map.bad.iter().all(|row| row.len() == wide);
    if !even || map.bits.len() != high || map.bad.len() != high {
        return Err(format!("its cells are not {wide} by {high}"));
    }
    for m in &map.roughness {
        check_figure("roughness", *m, 1.0)?;
    }
    for degrees in &map.degrees {
        check_figure("degrees", *degrees, MOST_DEGREES)?;
    }
    for bits in map.bits.iter().flatten().flatten() {
        check_figure("bits", *bits, MOST_BITS)?;
    }
    Ok(())
}
