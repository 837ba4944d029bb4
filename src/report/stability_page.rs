//! How does a stability report become a page that needs nothing but itself?

use std::fmt::Write as _;

use super::bench_words::thousands;
use super::heat_map::{Cell, HeatMap, STEPS};
use super::page;
use super::plot::{escape, put};
use super::stability::{
    ALIGN, BitsMap, COST_ALIGN, COST_HEAD, HEAD, SUMMARY_ALIGN, SUMMARY_HEAD, StabilityReport,
    cells, cost_cells, summary_cells,
};
use super::stability_beside::{self, Beside};
use super::stability_headlines::headlines;
use super::table::Align;

/// Bits of a float.
const BITS: f64 = 24.0;

/// The page; with another report also in what that differs.
pub fn page(report: &StabilityReport, there: Option<&StabilityReport>) -> String {
    let title = "Which values can be trusted";
    let mut page = page::begin(title, "umber stability", &report.device);
    let said = headlines(report).into_iter();
    let said = said.map(|headline| (format!("row-{}", headline.row), headline.text));
    let under = match report.costs.is_empty() {
        true => "Each sentence leads to its row.",
        false => page::UNDER_HEADLINES,
    };
    page::write_headlines(&mut page, said, under);
    write_functions(&mut page, report);
    write_maps(&mut page, report);
    write_costs(&mut page, report);
    if let Some(there) = there {
        write_beside(&mut page, report, there);
    }
    write_method(&mut page, report);
    page::write_machine(&mut page, &report.device, &report.machine, &report.program);
    write_rows(&mut page, report);
    page::end(&mut page);
    page
}

/// All cases of each function, and the way to its worst.
fn write_functions(page: &mut String, report: &StabilityReport) {
    page.push_str("<h2>Functions</h2>\n<p class=\"under\">All cases together; a line leads to its worst. max error: of the truth. of bound: the largest error over what is allowed there.</p>\n");
    begin_table(page, &SUMMARY_HEAD, &SUMMARY_ALIGN);
    for summary in report.summaries() {
        let [function, rest @ ..] = summary_cells(&summary);
        let (row, function) = (summary.row, escape(&function));
        put!(page, "<tr><td><a href=\"#row-{row}\">{function}</a></td>");
        write_cells(page, &rest, &SUMMARY_ALIGN[1..]);
        page.push_str("</tr>\n");
    }
    page.push_str(END_TABLE);
}

/// What another report has of the same functions.
fn write_beside(page: &mut String, here: &StabilityReport, there: &StabilityReport) {
    let Beside { about, rows } = Beside::new(here, there);
    let about = escape(&about);
    put!(
        page,
        "<h2>Beside another report</h2>\n<p class=\"under\">{about}</p>\n"
    );
    if rows.is_empty() {
        return;
    }
    let head = stability_beside::head();
    begin_table(page, &head, &SUMMARY_ALIGN);
    let mut last = String::new();
    for row in rows {
        if row.function != last {
            write_title(page, &row.function, head.len());
        }
        page.push_str("<tr>");
        write_cells(page, &row.cells, &SUMMARY_ALIGN);
        page.push_str("</tr>\n");
        last = row.function;
    }
    page.push_str(END_TABLE);
}

fn write_maps(page: &mut String, report: &StabilityReport) {
    if report.maps.is_empty() {
        return;
    }
    page.push_str("<h2>Bits lost</h2>\n<p class=\"under\">Of the 24 bits of a float, how many are wrong at worst: ");
    for step in 0..STEPS {
        let from = BITS * step as f64 / STEPS as f64;
        put!(
            page,
            "<span class=\"key\"><svg viewBox=\"0 0 10 10\"><rect class=\"heat-{step}\" width=\"10\" height=\"10\"/></svg>{from:.0}</span> "
        );
    }
    page.push_str("<span class=\"key\"><svg viewBox=\"0 0 10 10\"><rect class=\"heat-bad\" width=\"10\" height=\"10\"/></svg>NaN, infinite or negative</span></p>\n<div class=\"maps\">\n");
    // A listing, and beside it what stands for it.
    let family = |map: &&BitsMap| {
        let name = map.function.trim_start_matches("slides-");
        (name.to_owned(), name == map.function, map.tier.clone())
    };
    let mut maps: Vec<&BitsMap> = report.maps.iter().collect();
    maps.sort_by_key(family);
    for map in maps {
        let title = escape(&format!("{}, {}", map.function, map.tier));
        put!(
            page,
            "<figure>\n<h3>{title}</h3>\n{}</figure>\n",
            picture(map).svg()
        );
    }
    page.push_str("</div>\n");
}

fn picture(map: &BitsMap) -> HeatMap<'static> {
    let decade = |m: &f64| {
        let exponent = m.log10();
        let near = (exponent - exponent.round()).abs() < 0.07;
        if near {
            format!("{:.0e}", 10_f64.powf(exponent.round()))
        } else {
            String::new()
        }
    };
    let named = |degrees: &f64| match degrees % 15.0 == 0.0 {
        true => format!("{degrees}"),
        false => String::new(),
    };
    let cell = |(bits, bad): (&Option<f64>, &u32), m: f64, degrees: f64| {
        let place = format!("roughness {m:.1e}, {degrees:.0} degrees");
        match (bits, bad) {
            (_, 1..) => Cell::Bad(format!("{place}: {bad} values are none or below 0")),
            (Some(bits), 0) => Cell::Level(bits / BITS, format!("{place}: {bits:.1} bits")),
            (None, 0) => Cell::Nothing,
        }
    };
    let row = |(j, degrees): (usize, &f64)| {
        let figures = map.bits[j].iter().zip(&map.bad[j]).zip(&map.roughness);
        figures
            .map(|(figure, m)| cell(figure, *m, *degrees))
            .collect()
    };
    HeatMap {
        x: "roughness",
        y: "angle of the light, degrees",
        columns: map.roughness.iter().map(|m| (*m, decade(m))).collect(),
        rows: map.degrees.iter().map(|d| (*d, named(d))).collect(),
        cells: map.degrees.iter().enumerate().map(row).collect(),
    }
}

/// What the safe forms cost.
fn write_costs(page: &mut String, report: &StabilityReport) {
    if report.costs.is_empty() {
        return;
    }
    page.push_str("<h2>Cost</h2>\n<p class=\"under\">An evaluation, net of reading its input and writing its result, beside the slides' listing; medians, intervals of 95 %.</p>\n");
    begin_table(page, &COST_HEAD, &COST_ALIGN);
    for row in &report.costs {
        page.push_str("<tr>");
        write_cells(page, &cost_cells(row), &COST_ALIGN);
        page.push_str("</tr>\n");
    }
    page.push_str(END_TABLE);
}

/// A table up to its first row.
fn begin_table(page: &mut String, head: &[&str], align: &[Align]) {
    page.push_str("<div class=\"wide\">\n<table>\n<thead>\n<tr>");
    for (head, align) in head.iter().zip(align) {
        put!(page, "<th{}>{}</th>", class(*align), escape(head));
    }
    page.push_str("</tr>\n</thead>\n<tbody>\n");
}

/// Its end.
const END_TABLE: &str = "</tbody>\n</table>\n</div>\n";

/// A line above rows that belong together.
fn write_title(page: &mut String, title: &str, columns: usize) {
    let title = escape(title);
    put!(page, "<tr><th colspan=\"{columns}\">{title}</th></tr>\n");
}

fn write_cells(page: &mut String, cells: &[String], align: &[Align]) {
    for (cell, align) in cells.iter().zip(align) {
        put!(page, "<td{}>{}</td>", class(*align), escape(cell));
    }
}

/// A column of numbers stands to the right.
fn class(align: Align) -> &'static str {
    match align {
        Align::Right => " class=\"number\"",
        Align::Left => "",
    }
}

fn write_method(page: &mut String, report: &StabilityReport) {
    page.push_str("<h2>Method</h2>\n");
    let items = [
        ("values", format!("{} in all, by a compute shader that includes the files that frames are shaded with.", thousands(report.evaluations))),
        ("truth", "The same formula in f64 at the same 32-bit vectors, whose dot and cross products keep all their digits; a test \
          holds it to 200 bits within 1e-12.".to_owned()),
        ("judged", "Values where accuracy is promised: cosines of 1e-6 and more, roughness of 1e-4 and more, the lobe at least \
          1e-6 of its peak. The others must be numbers of at least 0.".to_owned()),
        ("of bound", "The largest error over what is allowed there, relative to the truth: 2e-6 + 2e-7/c without a peak and \
          2e-6 + 1e-6/m + 3e-6/c with one in f32 (c: the smaller cosine, m: roughness), 2e-6 and 1e-5 in f32-compensated; in f16 2e-3 + 1e-3/c from a \
          cosine of 0.01 on for oren-nayar, 5e-3 for schlick-f.".to_owned()),
        ("bits lost", "log2(1 + error in units of the truth's last place).".to_owned()),
        ("chance", "Inputs that the shader draws; every value is counted, each hundredth judged.".to_owned()),
        ("worst", "The same, but of each hundred the one at which the tiers differ most is judged.".to_owned()),
        ("search", "From the worst inputs on, one or two floats at a time are moved until nothing worse is found.".to_owned()),
        ("maps", "For functions with a peak the eye is where a facet within 2.5 m of the normal mirrors the light, else \
          anywhere above.".to_owned()),
        ("listings", "The slides' listings are held against their own formulas, where those are defined. Nothing is promised of \
          them.".to_owned()),
        ("seed", report.seed.to_string()),
    ];
    page::write_items(page, &items);
}

fn write_rows(page: &mut String, report: &StabilityReport) {
    page.push_str("<h2>Rows</h2>\n");
    let (mut head, mut align) = (HEAD.to_vec(), ALIGN.to_vec());
    head.push("worst input");
    align.push(Align::Left);
    begin_table(page, &head, &align);
    let mut last = None;
    for (i, row) in report.rows.iter().enumerate() {
        let title = (&row.function, &row.tier);
        if last.replace(title) != Some(title) {
            write_title(page, &format!("{}, {}", row.function, row.tier), head.len());
        }
        put!(page, "<tr id=\"row-{i}\">");
        write_cells(page, &cells(row), &ALIGN);
        let worst = row.worst_input.as_deref().unwrap_or_default();
        put!(page, "<td>{}</td></tr>\n", escape(worst));
    }
    page.push_str(END_TABLE);
}
