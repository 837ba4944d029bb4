//! How does `umber bench` look on a terminal?

use super::bench::{BenchReport, BenchRow};
use super::bench_headlines::headlines;
use super::bench_words::{bounds, count, figure, group, groups, plain, records_only};
use super::table::{Align, write_table};

/// Columns of a row, on the terminal and on the page.
pub const COLUMNS: usize = 17;

/// Their heads, for a report of frames.
const HEADS: [&str; COLUMNS] = [
    "mode",
    "order",
    "of base %",
    "[95 %]",
    "submit-to-idle ms",
    "± MAD",
    "gpu ms",
    "record ns/draw",
    "± MAD",
    "pipelines",
    "sets",
    "push",
    "cold ms",
    "warm ms",
    "memory",
    "n",
    "note",
];

const ALIGN: [Align; COLUMNS] = {
    let mut align = [Align::Right; COLUMNS];
    align[0] = Align::Left;
    align[1] = Align::Left;
    align[3] = Align::Left;
    align[5] = Align::Left;
    align[8] = Align::Left;
    align[16] = Align::Left;
    align
};

/// The rows, cell by cell with the base first, and under them what they say.
pub fn table(report: &BenchReport) -> String {
    let mut text = title(report);
    let rows: Vec<_> = groups(report)
        .into_iter()
        .flatten()
        .map(|i| &report.rows[i])
        .map(|row| (group_title(row), cells(row)))
        .collect();
    let mut heads = heads(report);
    for (column, head) in heads.iter_mut().enumerate() {
        // A plan without cold starts, or a queue without a clock, leaves whole columns empty.
        if rows.iter().all(|(_, cells)| cells[column].is_empty()) {
            *head = "";
        }
    }
    write_table(&mut text, heads, ALIGN, rows.into_iter());
    let headlines = headlines(report);
    if !headlines.is_empty() {
        text.push('\n');
    }
    for headline in headlines {
        text.push_str(&headline.text);
        text.push('\n');
    }
    text
}

/// The heads of the columns.
pub fn heads(report: &BenchReport) -> [&'static str; COLUMNS] {
    let mut heads = HEADS;
    if records_only(report) {
        heads[2] = "recording of base %";
    }
    heads
}

/// Whether a column's cells are numbers.
pub fn is_number(column: usize) -> bool {
    ALIGN.get(column) == Some(&Align::Right)
}

fn title(report: &BenchReport) -> String {
    let method = &report.method;
    let device = &report.device;
    let rows = count(report.rows.len() as u64, "row");
    let rounds = count(method.rounds.into(), "round");
    let [name, driver, version] =
        [&device.name, &device.driver, &device.driver_version].map(|text| plain(text));
    let (plan, method) = (plain(&method.plan), plain(&method.name));
    format!(
        "{name}, {driver} {version}; plan {plan}, method {method}, at least {rounds}; {rows}; [95 % intervals]\n"
    )
}

/// `tiny, 64 materials, 10,000 draws (640x360, 8 pixels a draw)`.
pub fn group_title(row: &BenchRow) -> String {
    let pixels = match row.scene.as_str() {
        "patches" | "null" => String::new(),
        _ => format!(", {} pixels a draw", figure(row.pixels_per_draw)),
    };
    format!("{} ({}x{}{pixels})", group(row), row.width, row.height)
}

/// What a row says, column by column; empty where it has nothing to say.
pub fn cells(row: &BenchRow) -> [String; COLUMNS] {
    let some = |x: Option<f64>| x.map_or(String::new(), figure);
    let mad = |x: Option<f64>| x.map_or(String::new(), |mad| format!("± {}", figure(mad)));
    let is_base = row.mode == row.base;
    let digits = match row.relative {
        // A tenth of a percent shows below 10 times.
        Some(relative) if relative < 10.0 => 1,
        _ => 0,
    };
    let percent = |x: f64| format!("{:.digits$}", 100.0 * x);
    let interval = match bounds(row.relative_95) {
        Some((low, high)) if !is_base => format!("[{}, {}]", percent(low), percent(high)),
        _ => String::new(),
    };
    let other_base = match row.base.as_str() {
        "one-pipeline" => String::new(),
        _ if is_base => String::new(),
        base => format!(" of {}", plain(base)),
    };
    let measured = row.samples > 0;
    let binds = |number: u64| match measured {
        true => number.to_string(),
        false => String::new(),
    };
    [
        plain(&row.mode),
        plain(&row.order),
        row.relative.map_or(String::new(), percent),
        format!("{interval}{other_base}").trim_start().to_owned(),
        some(row.submit_to_idle_ms),
        mad(row.submit_to_idle_mad),
        some(row.gpu_ms),
        some(row.record_ns_per_draw),
        mad(row.record_mad),
        binds(row.pipeline_binds),
        binds(row.descriptor_set_binds),
        binds(row.push_constants),
        some(row.creation_cold_ms),
        some(row.creation_warm_ms),
        match measured {
            true => memory(row.memory_bytes),
            false => String::new(),
        },
        match measured {
            true => row.samples.to_string(),
            false => String::new(),
        },
        plain(&row.note),
    ]
}

/// `0`, `512 B`, `1.5 KiB`, `12 MiB`.
fn memory(bytes: u64) -> String {
    let units = ["B", "KiB", "MiB", "GiB", "TiB"];
    let steps = bytes.checked_ilog2().unwrap_or(0) / 10;
    let steps = (steps as usize).min(units.len() - 1);
    match bytes {
        0 => "0".to_owned(),
        1..1024 => format!("{bytes} B"),
        _ => {
            let number = bytes as f64 / 1024.0_f64.powi(steps as i32);
            let digits = usize::from(number < 10.0);
            format!("{number:.digits$} {}", units[steps])
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn memory_has_the_unit_that_suits_it() {
        for (bytes, want) in [
            (0, "0"),
            (512, "512 B"),
            (1536, "1.5 KiB"),
            (12 << 20, "12 MiB"),
            (3 << 30, "3.0 GiB"),
            (u64::MAX, "16777216 TiB"),
        ] {
            assert_eq!(memory(bytes), want);
        }
    }
}
