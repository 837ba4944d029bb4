//! Which charts does a bench report have, and which rows stand in them?

use std::collections::{BTreeMap, BTreeSet};

use super::bench::{BenchReport, BenchRow};
use super::bench_headlines::pick;
use super::bench_words::{bounds, cell, count, figure, plain, ratio, records_only};
use super::plot::{Bar, Chart, Figure, Line, Mark, Point, Shape, Style, bars, chart};

/// How a mode looks, family by family: what is bound, how it is drawn, what is compiled in.
fn style(mode: &str) -> Style {
    let (colour, shape) = match mode {
        "one-pipeline" => ("ink", Shape::Disc),
        "pipeline-per-material" => ("red", Shape::Disc),
        "pipeline-and-set" => ("red", Shape::Square),
        "same-pipeline-again" => ("red", Shape::Triangle),
        "set-per-material" => ("blue", Shape::Disc),
        "same-set-again" => ("blue", Shape::Triangle),
        "push-constant" => ("green", Shape::Disc),
        "dynamic-uniform" => ("green", Shape::Square),
        "texture-per-material" => ("violet", Shape::Disc),
        "texture-array" => ("violet", Shape::Square),
        "indirect" => ("sky", Shape::Disc),
        "instanced" => ("sky", Shape::Square),
        "dynamic" => ("amber", Shape::Diamond),
        _ => ("grey", Shape::Diamond),
    };
    Style {
        colour,
        dashed: false,
        shape,
    }
}

/// A figure of a row, and its spread.
type Value = fn(&BenchRow) -> Option<(f64, Option<f64>, Option<f64>)>;

fn relative(row: &BenchRow) -> Option<(f64, Option<f64>, Option<f64>)> {
    let interval = bounds(row.relative_95).unzip();
    Some((row.relative?, interval.0, interval.1))
}

/// ns, from the submission until the device is idle.
fn submit_per_draw(row: &BenchRow) -> Option<(f64, Option<f64>, Option<f64>)> {
    let scale = 1.0e6 / f64::from(row.draws);
    let value = row.submit_to_idle_ms? * scale;
    Some(with_mad(
        value,
        row.submit_to_idle_mad.map(|mad| mad * scale),
    ))
}

fn record_per_draw(row: &BenchRow) -> Option<(f64, Option<f64>, Option<f64>)> {
    Some(with_mad(row.record_ns_per_draw?, row.record_mad))
}

fn with_mad(value: f64, mad: Option<f64>) -> (f64, Option<f64>, Option<f64>) {
    (
        value,
        mad.map(|mad| value - mad),
        mad.map(|mad| value + mad),
    )
}

/// All charts that have something to show.
pub fn figures(report: &BenchReport) -> Vec<Figure> {
    let mut figures = overview(report);
    let ms = if records_only(report) {
        "recording"
    } else {
        "submit-to-idle"
    };
    let ratio = format!("{ms} over the base's");
    for scene in ["tiny", "zoo"] {
        figures.extend(by_materials(report, scene, &ratio));
    }
    for (scene, value, y) in [
        (
            "tiny",
            submit_per_draw as Value,
            "submit-to-idle a draw, ns",
        ),
        ("zoo", submit_per_draw, "submit-to-idle a draw, ns"),
        ("tiny", record_per_draw, "recording a draw, ns"),
        ("null", record_per_draw, "recording a draw, ns"),
    ] {
        figures.extend(by_draws(report, scene, value, y));
    }
    figures.extend(patches(report, &ratio));
    figures.extend(creation(report));
    figures
}

/// A bar for each mode, a panel for each scene, all on one scale.
fn overview(report: &BenchReport) -> Vec<Figure> {
    let panels = ["tiny", "zoo", "bare"].map(|scene| (scene, picked(report, scene)));
    let rows = panels.iter().flat_map(|(_, picked)| picked);
    let ends = rows.flat_map(|(row, sorted)| {
        let row = &report.rows[*row];
        let high = bounds(row.relative_95).map(|bounds| bounds.1);
        let sorted = sorted.and_then(|sorted| report.rows[sorted].relative);
        [row.relative, high, sorted]
    });
    let most = ends.flatten().filter(|x| x.is_finite()).fold(1.0, f64::max);
    let what = if records_only(report) {
        "recording"
    } else {
        "submit-to-idle"
    };
    let mut figures = Vec::new();
    for (scene, picked) in panels {
        let main = picked.first().map(|(row, _)| &report.rows[*row]);
        let Some(main) = main else { continue };
        let bar = |(row, sorted): &(usize, Option<usize>)| {
            let of = |i: usize| point(report, i, 0.0, relative);
            let shown = &report.rows[*row];
            let elsewhere = (shown.materials, shown.draws) != (main.materials, main.draws);
            let cell = match elsewhere {
                true => format!(" ({}, {})", shown.materials, shown.draws),
                false => String::new(),
            };
            Some(Bar {
                name: format!("{}{cell}{}", plain(&shown.mode), dagger(shown)),
                style: style(&shown.mode),
                value: of(*row)?,
                other: sorted.and_then(of),
            })
        };
        let all: Vec<Bar> = picked.iter().filter_map(bar).collect();
        let Some(svg) = bars(&all, most * 1.04, &format!("{what} over the base's")) else {
            continue;
        };
        let (materials, draws) = (main.materials.into(), main.draws.into());
        let (materials, draws) = (count(materials, "material"), count(draws, "draw"));
        figures.push(Figure {
            title: format!("What each mode takes: {scene}, {materials}, {draws}"),
            svg,
            caption: format!(
                "{} Bars: shuffled. ◇: the same sorted by material. Whiskers: 95 %. The line is the base.{}",
                what_scene(scene),
                daggers(&all.iter().map(|bar| bar.name.as_str()).collect::<Vec<_>>())
            ),
        });
    }
    figures
}

fn what_scene(scene: &str) -> &'static str {
    match scene {
        "tiny" => "Triangles of about 8 pixels: what the driver costs.",
        "zoo" => "Balls under four lamps: what a user pays.",
        "bare" => "Triangles that read one uniform block: what a state command costs by itself.",
        "patches" => "Squares of growing size, each of a material of its own.",
        _ => "Nothing is rasterised.",
    }
}

/// The rows that sentences would be about, shuffled with sorted; in the order of their ratios.
fn picked(report: &BenchReport, scene: &str) -> Vec<(usize, Option<usize>)> {
    let modes: BTreeSet<&str> = report.rows.iter().map(|row| row.mode.as_str()).collect();
    let height = |mode: &str| {
        let found = [scene, "tiny", "zoo"].map(|scene| pick(report, scene, mode, "shuffled"));
        let row = found.into_iter().flatten().next();
        row.and_then(|row| report.rows[row].relative)
    };
    let mut modes: Vec<_> = modes.into_iter().map(|mode| (height(mode), mode)).collect();
    modes.sort_by(|a, b| a.0.unwrap_or(0.0).total_cmp(&b.0.unwrap_or(0.0)));
    let rows = modes.into_iter().filter_map(|(_, mode)| {
        let row = pick(report, scene, mode, "shuffled")?;
        let sorted = pick(report, scene, mode, "sorted");
        let same = |i: &usize| {
            let (a, b) = (&report.rows[row], &report.rows[*i]);
            (a.materials, a.draws) == (b.materials, b.draws)
        };
        Some((row, sorted.filter(same)))
    });
    rows.collect()
}

/// Ratios against materials.
fn by_materials(report: &BenchReport, scene: &str, y: &str) -> Option<Figure> {
    let draws = widest(report, scene, |row| (row.draws, row.materials))?;
    let fits = |row: &BenchRow| row.draws == draws && row.mode != row.base && row.mode != "nothing";
    let lines = lines(
        report,
        scene,
        fits,
        |row| f64::from(row.materials),
        relative,
    );
    let draws = count(draws.into(), "draw");
    let svg = chart(&Chart {
        x: "materials".to_owned(),
        y: y.to_owned(),
        level: Some((1.0, "base".to_owned())),
        marks: Vec::new(),
        lines: several(lines)?,
    });
    let names: Vec<_> = report
        .rows
        .iter()
        .filter(|row| row.scene == scene && fits(row))
        .map(dagger)
        .collect();
    Some(Figure {
        title: format!("Against materials: {scene}, {draws}"),
        svg: svg?,
        caption: format!(
            "{} Shuffled, unless it says sorted. Bars: 95 %.{}",
            what_scene(scene),
            daggers(&names)
        ),
    })
}

/// Times a draw against draws.
fn by_draws(report: &BenchReport, scene: &str, value: Value, y: &str) -> Option<Figure> {
    let materials = widest(report, scene, |row| (row.materials, row.draws))?;
    let fits =
        |row: &BenchRow| row.materials == materials && row.draws > 0 && row.mode != "nothing";
    let lines = lines(report, scene, fits, |row| f64::from(row.draws), value);
    let svg = chart(&Chart {
        x: "draws".to_owned(),
        y: y.to_owned(),
        level: None,
        marks: Vec::new(),
        lines: several(lines)?,
    });
    let materials = count(materials.into(), "material");
    let what = y.split(" a draw").next().unwrap_or(y);
    let mut title = format!("{what} against draws: {scene}, {materials}");
    title[..1].make_ascii_uppercase();
    Some(Figure {
        title,
        svg: svg?,
        caption: format!(
            "{} Shuffled, unless it says sorted. Bars: ± MAD.",
            what_scene(scene)
        ),
    })
}

/// What a material's own pipeline and the single shader cost as pixels grow.
fn patches(report: &BenchReport, y: &str) -> Option<Figure> {
    let scene = "patches";
    let materials = widest(report, scene, |row| {
        (row.materials, row.pixels_per_draw.round() as u32)
    })?;
    let fits = |row: &BenchRow| {
        let shown = ["pipeline-per-material", "dynamic"].contains(&row.mode.as_str());
        row.materials == materials && shown
    };
    let lines = lines(report, scene, fits, |row| row.pixels_per_draw, relative);
    let marks = report
        .break_even
        .iter()
        .filter(|even| even.materials == materials);
    let marks = marks.filter_map(|even| {
        let pixels = even.pixels?;
        let interval = even.pixels_95;
        Some(Mark {
            x: pixels,
            low: interval.and_then(|interval| interval.low),
            high: interval.and_then(|interval| interval.high),
            name: format!("even with {}: {}", plain(&even.single), figure(pixels)),
        })
    });
    let svg = chart(&Chart {
        x: "pixels a draw".to_owned(),
        y: y.to_owned(),
        level: Some((1.0, "one-pipeline".to_owned())),
        marks: marks.collect(),
        lines: several(lines)?,
    });
    let materials = count(materials.into(), "material");
    Some(Figure {
        title: format!("Against pixels: patches, {materials}"),
        svg: svg?,
        caption: format!(
            "{} Below 1 a pipeline of its own is faster. Bands: from where it may be even, 95 %.",
            what_scene(scene)
        ),
    })
}

/// Making the pipelines, cold and warm, against materials.
fn creation(report: &BenchReport) -> Option<Figure> {
    let scene = ["tiny", "zoo"].into_iter().find(|scene| {
        let mut rows = report.rows.iter();
        rows.any(|row| row.scene == *scene && row.creation_cold_ms.is_some())
    })?;
    let draws = widest(report, scene, |row| (row.draws, row.materials))?;
    let shown = [
        "one-pipeline",
        "dynamic",
        "set-per-material",
        "pipeline-per-material",
    ];
    let fits = |row: &BenchRow| row.draws == draws && shown.contains(&row.mode.as_str());
    let materials = |row: &BenchRow| f64::from(row.materials);
    let cold: Value = |row| Some((row.creation_cold_ms?, None, None));
    let warm: Value = |row| Some((row.creation_warm_ms?, None, None));
    let mut all = Vec::new();
    for (value, temperature) in [(cold, "cold"), (warm, "warm")] {
        let mut lines = lines(report, scene, fits, materials, value);
        lines.retain(|line| !line.style.dashed);
        for line in &mut lines {
            line.name.push_str(&format!(", {temperature}"));
            line.style.dashed = temperature == "warm";
        }
        all.extend(lines);
    }
    let svg = chart(&Chart {
        x: "materials".to_owned(),
        y: "creation, ms".to_owned(),
        level: None,
        marks: Vec::new(),
        lines: several(all)?,
    });
    Some(Figure {
        title: format!("Making the pipelines: {scene}, {}", count(draws.into(), "draw")),
        svg: svg?,
        caption: "Pipelines and the first frame beyond the median one, each in a process of its own: without any \
                  cache (cold), and with the caches that an earlier one filled (warm)."
            .to_owned(),
    })
}

/// Of a scene's rows, the value of `held` at which `swept` takes the most values: along it the sweep went.
fn widest(
    report: &BenchReport,
    scene: &str,
    held_swept: impl Fn(&BenchRow) -> (u32, u32),
) -> Option<u32> {
    let mut sweeps: BTreeMap<u32, BTreeSet<u32>> = BTreeMap::new();
    for row in report.rows.iter().filter(|row| row.scene == scene) {
        let (held, swept) = held_swept(row);
        sweeps.entry(held).or_default().insert(swept);
    }
    let widest = sweeps.into_iter().max_by_key(|(_, swept)| swept.len());
    widest.map(|(held, _)| held)
}

/// A line for each mode, shuffled; and one for a pipeline a material, sorted: that is how one would draw it.
fn lines(
    report: &BenchReport,
    scene: &str,
    fits: impl Fn(&BenchRow) -> bool,
    x: impl Fn(&BenchRow) -> f64,
    value: Value,
) -> Vec<Line> {
    let mut lines: BTreeMap<(&str, bool), Line> = BTreeMap::new();
    for (i, row) in report.rows.iter().enumerate() {
        let sorted = row.order == "sorted";
        let wanted = match row.order.as_str() {
            "shuffled" => true,
            _ => sorted && row.mode == "pipeline-per-material",
        };
        if row.scene != scene || !wanted || !fits(row) {
            continue;
        }
        let Some(point) = point(report, i, x(row), value) else {
            continue;
        };
        let line = lines.entry((&row.mode, sorted)).or_insert_with(|| Line {
            name: format!(
                "{}{}{}",
                plain(&row.mode),
                if sorted { ", sorted" } else { "" },
                dagger(row)
            ),
            style: Style {
                dashed: sorted,
                ..style(&row.mode)
            },
            points: Vec::new(),
        });
        line.points.push(point);
    }
    lines.into_values().collect()
}

/// Lines, if any of them goes from somewhere to somewhere.
fn several(lines: Vec<Line>) -> Option<Vec<Line>> {
    let far = |line: &Line| line.points.windows(2).any(|pair| pair[0].x != pair[1].x);
    lines.iter().any(far).then_some(lines)
}

fn point(report: &BenchReport, i: usize, x: f64, value: Value) -> Option<Point> {
    let row = &report.rows[i];
    let (y, low, high) = value(row)?;
    let times = ratio(row).map_or(String::new(), |ratio| {
        format!("\n{ratio} times {}", plain(&row.base))
    });
    Some(Point {
        x,
        y,
        low,
        high,
        across: None,
        anchor: anchor(i),
        told: format!("{}: {}\n{}{times}", plain(&row.mode), cell(row), figure(y)),
    })
}

/// What a row is called within the page.
pub fn anchor(row: usize) -> String {
    format!("row-{row}")
}

/// A mark at what is not compared with one pipeline.
fn dagger(row: &BenchRow) -> &'static str {
    match row.base.as_str() {
        "texture-array" => " †",
        _ => "",
    }
}

fn daggers(names: &[&str]) -> &'static str {
    match names.iter().any(|name| name.ends_with('†')) {
        true => " †: over texture-array.",
        false => "",
    }
}
