//! How does a cost report become a page that needs nothing but itself?

use std::fmt::Write as _;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;

use super::cost::{
    CostReport, PROMISE_HEAD, SCENE_HEAD, TIER_HEAD, TierRow, promise_cells, scene_cells,
    tier_cells,
};
use super::cost_headlines::headlines;
use super::cost_plots::{anchor, figures};
use super::page;
use super::plot::{escape, put};

/// A small picture, and what is told under it.
pub struct Sample {
    /// The scene's file.
    pub scene: String,
    /// What drew it.
    pub tier: String,
    /// Its mean of FLIP; none for the reference.
    pub flip_mean: Option<f64>,
    /// PNG.
    pub png: Vec<u8>,
}

/// The page. Each scene's `samples` follow each other.
pub fn page(report: &CostReport, samples: &[Sample]) -> String {
    let mut page = page::begin("What accuracy costs", "umber cost", &report.device);
    let said = headlines(report).into_iter();
    let said = said.map(|headline| (headline.row, headline.text));
    page::write_headlines(&mut page, said, page::UNDER_HEADLINES);
    page::write_figures(&mut page, "Error against time", &figures(report));
    write_sheets(&mut page, samples);
    write_method(&mut page, report);
    page::write_machine(&mut page, &report.device, &report.machine, &report.program);
    write_rows(&mut page, report);
    page::end(&mut page);
    page
}

fn write_sheets(page: &mut String, samples: &[Sample]) {
    if samples.is_empty() {
        return;
    }
    page.push_str("<h2>Pictures</h2>\n<p class=\"under\">The reference, then models from the worst to the nearest, each with its mean of FLIP: those that no other beats in error and frame time, and the slides'.</p>\n");
    for sheet in samples.chunk_by(|a, b| a.scene == b.scene) {
        let scene = sheet.first().map_or("", |sample| sample.scene.as_str());
        put!(page, "<h3>{}</h3>\n<div class=\"sheet\">\n", escape(scene));
        for sample in sheet {
            let told = match sample.flip_mean {
                Some(flip) => format!("{flip:.4}  {}", sample.tier),
                None => sample.tier.clone(),
            };
            let told = escape(&told);
            put!(
                page,
                "<figure><img alt=\"{told}\" src=\"data:image/png;base64,{}\"/><figcaption>{told}</figcaption></figure>\n",
                STANDARD.encode(&sample.png)
            );
        }
        page.push_str("</div>\n");
    }
}

fn write_method(page: &mut String, report: &CostReport) {
    let method = &report.method;
    page.push_str("<h2>Method</h2>\n");
    let items = [
        (
            "ns",
            "Time of an evaluation in a compute shader that includes the files that frames are shaded with, at half a million inputs \
             a sample, or three times as many: any light and eye above the surface, any material. Median of 21 samples, net of a shader that only reads and \
             sums. Each form takes turns with the slides' listings, and is compared with them round by round."
                .to_owned(),
        ),
        (
            "ns/fragment",
            format!(
                "Time of a fragment in a frame of eight blended layers of 128 x 128 under {} lamps, beyond Lambert's without an \
                 interface, so that fetching lamps, interpolation and blending count for none; what is done once a pixel is shared by \
                 the lamps.",
                method.lamps
            ),
        ),
        (
            "error",
            "Of a base: against Oren and Nayar's V-cavities, traced path by path. Of facets: against the Smith microsurface. Of \
             Fresnel terms: absolute, against spectra of metals. RMS over angles and surfaces. Of a model: \
             mean error of radiance in the pictures."
                .to_owned(),
        ),
        (
            "FLIP",
            format!(
                "Andersson et al. 2020, at 67 pixels a degree, of pictures of {} x {} after exposure and tone mapping, against a reference \
                 picture: the frame's own stages write position, normal, eye, material and shadow of each pixel; f64 shades them by eon, \
                 ggx-multi and the Fresnel term that the material has numbers for. Every material is made opaque, so that a pixel has \
                 one surface. A tier's FLIP is that of the best model with the tier in its place; a hole left by a NaN counts as black.",
                method.size.0, method.size.1
            ),
        ),
        (
            "frames",
            format!(
                "Models take turns with the default one, {} frames each, on shadow maps that were drawn before; only frames of one round are \
                 compared.",
                method.rounds
            ),
        ),
        ("*", "No other tier of the term, or model, has a smaller error in less time.".to_owned()),
        ("rounding", "The largest error of the 32-bit function against its twin in f64, at random angles above the surface.".to_owned()),
        ("SPIR-V", "Instructions of the surface's shader beyond those without light, after spirv-opt. What the driver tells of its own code, if it \
                 does, is in the JSON: driver_statistics.".to_owned()),
        ("clock", report.program.clock.clone()),
    ];
    page::write_items(page, &items);
    page.push_str("<h2>Limits</h2>\n<ul>\n");
    for limit in limits(report) {
        put!(page, "<li>{}</li>\n", escape(limit));
    }
    put!(
        page,
        "</ul>\n<h2>Again</h2>\n<pre><code>umber cost --{} --json=again.json</code></pre>\n",
        escape(&method.plan)
    );
}

fn limits(report: &CostReport) -> Vec<&'static str> {
    let mut limits = vec![
        "One device, one driver: another's ratios are other ratios.",
        "An error on these surfaces, and in these pictures, is none on others.",
    ];
    match report.device.kind.as_str() {
        "cpu" => limits.push("A CPU shades: ratios of arithmetic are its own, and no graphics card's."),
        _ => limits.push(
            "Fragments are drawn by a part of the device only; compute times are of all of it. They are never compared.",
        ),
    }
    limits
}

fn write_rows(page: &mut String, report: &CostReport) {
    page.push_str("<h2>Rows</h2>\n");
    let rows: Vec<&TierRow> = report.rows.iter().collect();
    let groups = rows.chunk_by(|a, b| a.term == b.term).map(|group| {
        let title = group.first().map_or(String::new(), |row| row.term.clone());
        let rows = group.iter().map(|row| (anchor(row), tier_cells(row)));
        (title, rows.collect::<Vec<_>>())
    });
    write_table(page, TIER_HEAD, &groups.collect::<Vec<_>>());
    page.push_str("<h2>Scenes</h2>\n");
    let mut scenes: Vec<Group<7>> = Vec::new();
    for row in report.of_term("model") {
        for scene in &row.scenes {
            let cells = (String::new(), scene_cells(&row.tier, scene));
            match scenes.iter_mut().find(|(name, _)| *name == scene.scene) {
                Some((_, rows)) => rows.push(cells),
                None => scenes.push((scene.scene.clone(), vec![cells])),
            }
        }
    }
    write_table(page, SCENE_HEAD, &scenes);
    page.push_str("<h2>Promises</h2>\n<p class=\"under\">umber render --max-error E takes the cheapest model whose mean of FLIP is at most E.</p>\n");
    let promises = report.promises.chunk_by(|a, b| a.scene == b.scene);
    let promises = promises.map(|group| {
        let title = group.first().map_or(String::new(), |row| row.scene.clone());
        let rows = group.iter().map(|row| (String::new(), promise_cells(row)));
        (title, rows.collect::<Vec<_>>())
    });
    write_table(page, PROMISE_HEAD, &promises.collect::<Vec<_>>());
}

/// A title and its rows, each with its anchor.
type Group<const N: usize> = (String, Vec<(String, [String; N])>);

fn write_table<const N: usize>(page: &mut String, head: [&str; N], groups: &[Group<N>]) {
    page.push_str("<div class=\"wide\">\n<table>\n<thead>\n<tr>");
    let class = |column| if column > 0 { " class=\"number\"" } else { "" };
    for (column, head) in head.iter().enumerate() {
        put!(page, "<th{}>{}</th>", class(column), escape(head));
    }
    page.push_str("</tr>\n</thead>\n");
    for (title, rows) in groups {
        put!(
            page,
            "<tbody>\n<tr><th colspan=\"{N}\">{}</th></tr>\n",
            escape(title)
        );
        for (anchor, cells) in rows {
            let id = match anchor.as_str() {
                "" => String::new(),
                anchor => format!(" id=\"{}\"", escape(anchor)),
            };
            put!(page, "<tr{id}>");
            for (column, cell) in cells.iter().enumerate() {
                put!(page, "<td{}>{}</td>", class(column), escape(cell));
            }
            page.push_str("</tr>\n");
        }
        page.push_str("</tbody>\n");
    }
    page.push_str("</table>\n</div>\n");
}
