//! What does a bench report say in sentences? What its rows say, and nothing where a row is missing.

use std::collections::BTreeMap;

use super::bench::{BenchReport, BenchRow, BreakEven};
use super::bench_words::{bounds, cell, count, figure, plain, ratio, records_only, thousands};
use crate::math::statistics::median;

/// The cell that a sentence is about, where it was measured.
const MATERIALS: u32 = 64;
const DRAWS: u32 = 10_000;

/// Below this share of the frame a difference is told as small.
const SMALL: f64 = 0.05;

/// Closer than this, device and host time are told as one.
const ALIKE: f64 = 0.02;

/// A sentence.
#[derive(Clone, PartialEq, Eq, Debug, serde::Serialize)]
pub struct Headline {
    /// It, with its full stop.
    pub text: String,
    /// The row of the report that has its figure.
    pub row: usize,
}

/// Modes of which each cell says something, in this order.
const MODES: [(&str, &str); 15] = [
    ("pipeline-per-material", "shuffled"),
    ("pipeline-per-material", "sorted"),
    ("same-pipeline-again", "shuffled"),
    ("pipeline-and-set", "shuffled"),
    ("set-per-material", "shuffled"),
    ("same-set-again", "shuffled"),
    ("push-constant", "shuffled"),
    ("dynamic-uniform", "shuffled"),
    ("texture-array", "shuffled"),
    ("texture-per-material", "shuffled"),
    ("indirect", "shuffled"),
    ("instanced", "shuffled"),
    ("dynamic", "shuffled"),
    ("no-blend", "shuffled"),
    ("nothing", "shuffled"),
];

/// Of these the zoo says something in any case; of the others where they do not matter to it.
const ALWAYS: [&str; 3] = ["pipeline-per-material", "set-per-material", "dynamic"];

/// Modes of which bare triangles say something.
const BARE: [(&str, &str); 5] = [
    ("pipeline-per-material", "shuffled"),
    ("pipeline-per-material", "sorted"),
    ("same-pipeline-again", "shuffled"),
    ("set-per-material", "shuffled"),
    ("push-constant", "shuffled"),
];

/// The sentences, the first the most telling.
pub fn headlines(report: &BenchReport) -> Vec<Headline> {
    let mut rows = Vec::new();
    for (mode, order) in MODES {
        let found = ["tiny", "zoo"].map(|scene| pick(report, scene, mode, order));
        rows.extend(found.into_iter().flatten().next());
    }
    let bare = BARE.map(|(mode, order)| pick(report, "bare", mode, order));
    rows.extend(bare.into_iter().flatten());
    for (mode, order) in MODES {
        let Some(row) = pick(report, "zoo", mode, order) else {
            continue;
        };
        let telling = ALWAYS.contains(&mode) || mode != "nothing" && no_matter(&report.rows[row]);
        if telling && !rows.contains(&row) {
            rows.push(row);
        }
    }
    let mut headlines: Vec<_> = rows
        .into_iter()
        .filter_map(|row| headline(row, sentence(report, row)))
        .collect();
    headlines.extend(unread_storage(report));
    headlines.extend(
        report
            .break_even
            .iter()
            .filter_map(|even| break_even(report, even)),
    );
    headlines.extend(caveats(
        report,
        headlines.first().map_or(0, |first| first.row),
    ));
    headlines
}

fn headline(row: usize, text: Option<String>) -> Option<Headline> {
    text.map(|text| Headline { text, row })
}

/// The row of a mode that sentences are about: 64 materials and 10,000 draws, or else the most draws at the
/// number of materials that most of its rows have.
pub fn pick(report: &BenchReport, scene: &str, mode: &str, order: &str) -> Option<usize> {
    let fits = |row: &BenchRow| {
        let named = row.scene == scene && row.mode == mode && row.order == order;
        named && row.relative.is_some()
    };
    let found = || {
        let rows = report.rows.iter().enumerate();
        rows.filter(|(_, row)| fits(row))
    };
    let usual = found().find(|(_, row)| (row.materials, row.draws) == (MATERIALS, DRAWS));
    if let Some((row, _)) = usual {
        return Some(row);
    }
    let mut often = BTreeMap::new();
    for (_, row) in found() {
        *often.entry(row.materials).or_insert(0) += 1;
    }
    // The last of equal keys wins, so the order is turned: the fewest materials, the first row.
    let (materials, _) = often.into_iter().rev().max_by_key(|(_, times)| *times)?;
    let rows: Vec<_> = found()
        .filter(|(_, row)| row.materials == materials)
        .collect();
    let (row, _) = rows.into_iter().rev().max_by_key(|(_, row)| row.draws)?;
    Some(row)
}

/// Whether its interval holds 1, or all of it is less than 5 % away.
fn no_matter(row: &BenchRow) -> bool {
    undecided(row) || small(row)
}

fn undecided(row: &BenchRow) -> bool {
    bounds(row.relative_95).is_some_and(|(low, high)| low <= 1.0 && 1.0 <= high)
}

fn small(row: &BenchRow) -> bool {
    let within = |(low, high)| 1.0 - low < SMALL && high - 1.0 < SMALL;
    bounds(row.relative_95).is_some_and(within)
}

/// `A pipeline switch before every draw takes 5.1 (4.9 to 5.3) times one pipeline's frame: CELL.`
fn sentence(report: &BenchReport, row: usize) -> Option<String> {
    let row = &report.rows[row];
    let relative = row.relative?;
    let ratio = ratio(row)?;
    let what = if records_only(report) {
        "recording"
    } else {
        "frame"
    };
    let base = match row.base.as_str() {
        "one-pipeline" => format!("one pipeline's {what}"),
        "texture-array" => format!("the texture array's {what}"),
        other => format!("{}'s {what}", plain(other)),
    };
    let cell = told(row);
    if row.mode == "nothing" {
        return Some(harness(row, relative, &base, &cell));
    }
    let (subject, plural) = subject(row)?;
    let s = if plural { "" } else { "s" };
    let frames = count(row.samples.into(), "frame");
    let share = match row.mode.as_str() {
        "same-pipeline-again" => share_of_switch(report, row, "pipeline-per-material"),
        "same-set-again" => share_of_switch(report, row, "set-per-material"),
        _ => String::new(),
    };
    Some(if undecided(row) {
        format!("{subject} make{s} no difference that {frames} show: {ratio} times {base}; {cell}.")
    } else if small(row) {
        let adds = if relative > 1.0 { "add" } else { "save" };
        format!("{subject} {adds}{s} less than 5 %: {ratio} times {base}; {cell}.")
    } else {
        format!("{subject} take{s} {ratio} times {base}{share}: {cell}.")
    })
}

/// The cell, and what the row's note warns of.
fn told(row: &BenchRow) -> String {
    let mut text = cell(row);
    for part in row.note.split("; ") {
        if part.starts_with("capped") {
            text.push_str(&format!(", {}", plain(part)));
        } else if part.starts_with("noisy") {
            text.push_str(", noisy");
        }
    }
    text
}

/// Who takes the time, and whether they are many.
fn subject(row: &BenchRow) -> Option<(String, bool)> {
    let draws = u64::from(row.draws);
    let pipelines = before(row.pipeline_binds, draws);
    let sets = before(row.descriptor_set_binds, draws);
    let pushes = before(row.push_constants, draws);
    let one = |text: String| Some((text, false));
    match (row.mode.as_str(), row.order.as_str()) {
        ("pipeline-per-material", "sorted") => {
            let (number, es) = match row.pipeline_binds {
                1 => ("1".to_owned(), ""),
                many => (thousands(many), "es"),
            };
            let text = format!("Sorted by material, {number} pipeline switch{es}");
            Some((text, row.pipeline_binds != 1))
        }
        ("pipeline-per-material", _) => one(format!("A pipeline switch {pipelines}")),
        ("same-pipeline-again", _) => one(format!("The same pipeline bound again {pipelines}")),
        ("pipeline-and-set", _) => Some((
            format!("A pipeline switch and a descriptor set {pipelines}"),
            true,
        )),
        ("set-per-material", _) => one(format!("A descriptor set {sets}")),
        ("same-set-again", _) => one(format!("The same set bound again {sets}")),
        ("push-constant", _) => one(format!("A push constant {pushes}")),
        ("dynamic-uniform", _) => one(format!("A dynamic offset {sets}")),
        ("texture-array", _) => one("One array of all textures".to_owned()),
        ("texture-per-material", _) => one(format!("A set with a texture of its own {sets}")),
        ("indirect", _) => one("Indirect drawing".to_owned()),
        ("instanced", _) => one("Instanced drawing".to_owned()),
        ("dynamic", _) => one("One pipeline with every effect compiled in".to_owned()),
        ("no-blend", _) => one("One pipeline that does not blend".to_owned()),
        _ => None,
    }
}

/// `before every draw`, or before how many.
fn before(binds: u64, draws: u64) -> String {
    match binds {
        binds if binds >= draws => "before every draw".to_owned(),
        // u128: a count that was read from a file may be any.
        binds => match u128::from(binds) * 100 / u128::from(draws) {
            0 => format!("{} in {}", count(binds, "time"), count(draws, "draw")),
            percent => format!("before {percent} % of the draws"),
        },
    }
}

/// How much of what the change adds comes with the command alone, in the same cell.
fn share_of_switch(report: &BenchReport, again: &BenchRow, switch: &str) -> String {
    let same_cell = |row: &&BenchRow| {
        row.mode == switch
            && cell(row) == cell(again)
            && (row.width, row.height, &row.base) == (again.width, again.height, &again.base)
    };
    let switch = report.rows.iter().find(same_cell);
    let (Some(again), Some(switch)) = (again.relative, switch.and_then(|row| row.relative)) else {
        return String::new();
    };
    match again > 1.0 && switch > 1.0 + SMALL {
        true => {
            let share = 100.0 * (again - 1.0) / (switch - 1.0);
            format!(", {share:.0} % of what the change adds")
        }
        false => String::new(),
    }
}

/// What a plain draw takes longer where a storage buffer that no shader reads is in the set.
fn unread_storage(report: &BenchReport) -> Option<Headline> {
    let row = pick(report, "bare-storage", "one-pipeline", "shuffled")?;
    let storage = &report.rows[row];
    let same = |row: &&BenchRow| {
        (row.scene.as_str(), &row.mode, &row.order) == ("bare", &storage.mode, &storage.order)
            && (row.materials, row.draws) == (storage.materials, storage.draws)
    };
    let bare = report.rows.iter().find(same)?;
    let times = storage.submit_to_idle_ms? / bare.submit_to_idle_ms?;
    if !times.is_finite() {
        return None;
    }
    let text = format!(
        "A storage buffer that no shader reads makes a frame of plain draws take {} times as long: {} against {} ms, \
         {}.",
        figure(times),
        figure(storage.submit_to_idle_ms?),
        figure(bare.submit_to_idle_ms?),
        cell(storage)
    );
    headline(row, Some(text))
}

/// `nothing` draws nothing: what is left is the harness's.
fn harness(row: &BenchRow, relative: f64, base: &str, cell: &str) -> String {
    let percent = |x: f64| format!("{:.1}", 100.0 * x);
    let interval = match bounds(row.relative_95) {
        Some((low, high)) => format!("{} to {}", percent(low), percent(high)),
        None => "too few frames for an interval".to_owned(),
    };
    let share = percent(relative);
    format!(
        "Without any draw {share} % ({interval}) of {base} are left, the harness's share: {cell}."
    )
}

/// From where a material on a pipeline of its own pays; its row is the measured size nearest to it.
fn break_even(report: &BenchReport, even: &BreakEven) -> Option<Headline> {
    let patches = report.rows.iter().enumerate().filter(|(_, row)| {
        row.scene == "patches"
            && row.mode == "pipeline-per-material"
            && row.pixels_per_draw > 0.0
            && row.relative.is_some()
    });
    // Without a size at which it pays, the largest says most.
    let target = even.pixels.unwrap_or(f64::MAX);
    let distance = |row: &BenchRow| {
        let other = row.materials != even.materials;
        let sorted = row.order != "shuffled";
        (other, sorted, (row.pixels_per_draw / target).ln().abs())
    };
    let compare = |a: &(usize, &BenchRow), b: &(usize, &BenchRow)| {
        let (a, b) = (distance(a.1), distance(b.1));
        (a.0, a.1).cmp(&(b.0, b.1)).then(a.2.total_cmp(&b.2))
    };
    let (row, _) = patches.min_by(compare)?;
    let single = match even.single.as_str() {
        "one-pipeline" => "the single pipeline compiled for the scene".to_owned(),
        "dynamic" => "the single pipeline with every effect compiled in".to_owned(),
        other => plain(other),
    };
    let materials = count(even.materials.into(), "material");
    let own = "A pipeline for each material";
    let text = match even.pixels {
        None => format!("{own} is at no measured size faster than {single}: patches, {materials}."),
        Some(pixels) => {
            let interval = match even.pixels_95.map(|interval| (interval.low, interval.high)) {
                Some((Some(low), Some(high))) => format!(" ({} to {})", figure(low), figure(high)),
                Some((Some(low), None)) => format!(" (from {})", figure(low)),
                Some((None, Some(high))) => format!(" (to {})", figure(high)),
                _ => String::new(),
            };
            let pixels = figure(pixels);
            format!(
                "{own} is faster than {single} from {pixels}{interval} pixels a draw: patches, {materials}."
            )
        }
    };
    headline(row, Some(text))
}

/// What to know before any figure is carried elsewhere.
fn caveats(report: &BenchReport, first: usize) -> Vec<Headline> {
    let mut caveats = Vec::new();
    if report.rows.is_empty() {
        return caveats;
    }
    let name = plain(&report.device.name);
    let mut say = |row, text| caveats.push(Headline { text, row });
    if report.device.kind == "cpu" {
        say(
            first,
            format!("{name} is a CPU: all times are a CPU rasteriser's."),
        );
    }
    if matches!(report.device.kind.as_str(), "discrete" | "virtual") {
        if ["H100", "H200"].iter().any(|part| name.contains(part)) {
            say(
                first,
                format!(
                    "{name} is a data-centre device: fragment work runs on a small part of it."
                ),
            );
        } else if ["A100", "V100", "L40", "MI2", "MI3"]
            .iter()
            .any(|part| name.contains(part))
        {
            say(
                first,
                format!(
                    "{name} is a data-centre device: fragment work may run on a small part of it."
                ),
            );
        }
    }
    if let Some((row, apart)) = clocks_apart(report).filter(|(_, apart)| *apart <= ALIKE) {
        let percent = 100.0 * apart;
        say(
            row,
            format!(
                "The device's own time is submit-to-idle within {percent:.1} % in the median row: the two tell the same."
            ),
        );
    }
    caveats
}

/// How far the device's time is from the host's, relative, in the median row.
fn clocks_apart(report: &BenchReport) -> Option<(usize, f64)> {
    let apart = |row: &BenchRow| {
        let apart = (row.gpu_ms? / row.submit_to_idle_ms? - 1.0).abs();
        apart.is_finite().then_some(apart)
    };
    let rows = report.rows.iter().enumerate();
    let all: Vec<_> = rows.filter_map(|(i, row)| Some((i, apart(row)?))).collect();
    let middle = median(&all.iter().map(|(_, apart)| *apart).collect::<Vec<_>>())?;
    let off = |apart: f64| (apart - middle).abs();
    let (row, _) = all
        .into_iter()
        .min_by(|a, b| off(a.1).total_cmp(&off(b.1)))?;
    Some((row, middle))
}
