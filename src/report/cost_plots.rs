//! Which charts show what accuracy costs?

use super::cost::{CostReport, LampRow, TierRow};
use super::plot::{Chart, Figure, Line, Point, Shape, Style, chart};

/// All charts that the rows are enough for.
pub fn figures(report: &CostReport) -> Vec<Figure> {
    let terms = [
        ("diffuse", "The matte base", "RMS error of the base, %"),
        ("specular", "The facets", "RMS error of the facets, %"),
        (
            "fresnel",
            "The Fresnel term",
            "RMS error of the reflectance, %",
        ),
    ];
    let terms = terms.into_iter().filter_map(|(term, title, y)| {
        let error = |row: &TierRow| row.model_error_rms.map(|error| error * 100.0);
        let svg = scatter(report, term, y, error)?;
        Some(Figure {
            title: title.to_owned(),
            svg,
            caption: format!("{FRONT} Bars: 95 %. {}", of_term(term)),
        })
    });
    let mut figures: Vec<Figure> = terms.collect();
    if let Some(svg) = scatter(report, "model", "mean of FLIP, worst scene", |row| {
        row.flip_mean
    }) {
        figures.push(Figure {
            title: "The whole model".to_owned(),
            svg,
            caption: format!("{FRONT} Bars: 95 %."),
        });
    }
    let mut scenes: Vec<&str> = Vec::new();
    for scene in report.of_term("model").flat_map(|row| &row.scenes) {
        if !scenes.contains(&scene.scene.as_str()) {
            scenes.push(&scene.scene);
        }
    }
    figures.extend(
        scenes
            .into_iter()
            .filter_map(|scene| picture(report, scene)),
    );
    figures.extend(lamps(report));
    figures
}

const FRONT: &str = "Hollow and grey: another is nearer in less time.";

fn of_term(term: &str) -> &'static str {
    match term {
        "diffuse" => "A base alone, without an interface.",
        "specular" => "Facets alone, under Schlick's Fresnel term.",
        _ => "On GGX facets, whose time is in it.",
    }
}

/// Where a row is on the page.
pub fn anchor(row: &TierRow) -> String {
    format!("{}-{}", row.term, row.tier.replace([' ', '+'], "-"))
}

/// What an error of nothing is shown as, and what no time is: an axis of logarithms has no 0.
const FLOOR: f64 = 1e-4;
const NO_TIME: f64 = 0.02;

fn scatter(
    report: &CostReport,
    term: &str,
    y: &str,
    error: impl Fn(&TierRow) -> Option<f64>,
) -> Option<String> {
    let spots = report.of_term(term).filter_map(|row| {
        let bounds = &row.of_slides_95;
        Some(Spot {
            name: row.tier.clone(),
            anchor: anchor(row),
            x: row.of_slides?.max(NO_TIME),
            across: bounds
                .low
                .zip(bounds.high)
                .filter(|(low, _)| *low > NO_TIME),
            y: error(row)?.max(FLOOR),
            front: row.pareto,
        })
    });
    drawn(
        spots.collect(),
        "time of an evaluation, of the slides' listings",
        y,
    )
}

fn picture(report: &CostReport, name: &str) -> Option<Figure> {
    let spots = report.of_term("model").filter_map(|row| {
        let scene = row.scenes.iter().find(|scene| scene.scene == name)?;
        let bounds = &scene.of_default_95;
        Some(Spot {
            name: row.tier.clone(),
            anchor: anchor(row),
            x: scene.of_default?,
            across: bounds.low.zip(bounds.high),
            y: scene.flip_mean.max(FLOOR),
            front: scene.pareto,
        })
    });
    let svg = drawn(
        spots.collect(),
        "time of a frame, of the default model's",
        "mean of FLIP",
    )?;
    Some(Figure {
        title: format!("The picture: {name}"),
        svg,
        caption: format!(
            "{FRONT} Bars: 95 %. The frame holds all else too: vertices, maps, fetching shadows."
        ),
    })
}

/// A tier in a chart.
struct Spot {
    name: String,
    anchor: String,
    x: f64,
    across: Option<(f64, f64)>,
    y: f64,
    front: bool,
}

/// Names of a front that a chart has room for.
const NAMED: usize = 12;

/// The front as a line with its names; the rest as grey rings.
fn drawn(mut spots: Vec<Spot>, x: &str, y: &str) -> Option<String> {
    spots.sort_by(|a, b| a.x.total_cmp(&b.x));
    let few = spots.len() <= NAMED;
    let mut lines = Vec::new();
    let front = spots.iter().filter(|spot| spot.front);
    lines.push(Line {
        name: String::new(),
        style: style("red", false),
        points: front.map(point).collect(),
    });
    for spot in &spots {
        let named = spot.front || few || spot.name == "slides";
        lines.push(Line {
            name: if named {
                spot.name.clone()
            } else {
                String::new()
            },
            style: match spot.front {
                true => style("red", false),
                false => style("grey", true),
            },
            // Of a crowd, bars would hide each other.
            points: vec![Point {
                across: spot.across.filter(|_| named),
                ..point(spot)
            }],
        });
    }
    chart(&Chart {
        x: x.to_owned(),
        y: y.to_owned(),
        level: None,
        marks: Vec::new(),
        lines,
    })
}

fn style(colour: &'static str, dashed: bool) -> Style {
    Style {
        colour,
        dashed,
        shape: Shape::Disc,
    }
}

fn point(spot: &Spot) -> Point {
    Point {
        x: spot.x,
        y: spot.y,
        low: None,
        high: None,
        across: spot.across,
        anchor: spot.anchor.clone(),
        told: format!(
            "{}: {:.3} of the time, error {:.4}",
            spot.name, spot.x, spot.y
        ),
    }
}

/// A fragment's time as lamps grow.
fn lamps(report: &CostReport) -> Option<Figure> {
    const COLOURS: [(&str, Shape); 4] = [
        ("ink", Shape::Disc),
        ("red", Shape::Square),
        ("blue", Shape::Triangle),
        ("green", Shape::Diamond),
    ];
    let rows: Vec<&LampRow> = report.lamps.iter().collect();
    let lines = rows
        .chunk_by(|a, b| a.tier == b.tier)
        .zip(COLOURS.iter().cycle());
    let lines = lines.map(|(rows, (colour, shape))| Line {
        name: rows.first().map_or(String::new(), |row| row.tier.clone()),
        style: Style {
            colour,
            dashed: false,
            shape: *shape,
        },
        points: rows.iter().map(|row| lamp_point(row)).collect(),
    });
    let svg = chart(&Chart {
        x: "lamps".to_owned(),
        y: "ns a fragment".to_owned(),
        level: None,
        marks: Vec::new(),
        lines: lines.collect(),
    })?;
    Some(Figure {
        title: "Lamps".to_owned(),
        svg,
        caption: "Beyond Lambert's without an interface, whose time is that of fetching lamps. Bars: ± MAD.".to_owned(),
    })
}

fn lamp_point(row: &LampRow) -> Point {
    Point {
        x: f64::from(row.lamps),
        y: row.ns_per_fragment,
        low: Some(row.ns_per_fragment - row.ns_mad),
        high: Some(row.ns_per_fragment + row.ns_mad),
        across: None,
        anchor: format!("model-{}", row.tier.replace([' ', '+'], "-")),
        told: format!(
            "{}, {} lamps: {:.1} ns",
            row.tier, row.lamps, row.ns_per_fragment
        ),
    }
}
