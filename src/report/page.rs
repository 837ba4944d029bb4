//! What do all pages of reports have in common?
//!
//! A page is XML as well as HTML, so that a test can read it, and needs nothing but itself. Whatever comes from a report
//! is escaped: names are a driver's, and a report may be anyone's.

use std::fmt::Write as _;

use super::plot::{Figure, escape, put};
use super::provenance::{Device, Machine, Program};

/// The page up to its title, and a line on what measured.
pub fn begin(title: &str, verb: &str, device: &Device) -> String {
    let name = escape(&device.name);
    let mut page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
         <meta name=\"viewport\" content=\"width=device-width\"/>\n\
         <title>{title}: {name}</title>\n<style>\n{}</style>\n</head>\n<body>\n",
        include_str!("page.css")
    );
    put!(
        page,
        "<h1>{title}</h1>\n<p class=\"under\">Measured by {verb} on {name}, {} {}.</p>\n",
        escape(&device.driver),
        escape(&device.driver_version)
    );
    page
}

/// Its end.
pub fn end(page: &mut String) {
    page.push_str("</body>\n</html>\n");
}

/// Sentences, each with the anchor of the row that it stands on, and what is to be known of them all; nothing without one.
pub fn write_headlines(
    page: &mut String,
    headlines: impl IntoIterator<Item = (String, String)>,
    under: &str,
) {
    let mut headlines = headlines.into_iter().peekable();
    if headlines.peek().is_none() {
        return;
    }
    page.push_str("<ul class=\"say\">\n");
    for (row, text) in headlines {
        let (row, text) = (escape(&row), escape(&text));
        put!(page, "<li><a href=\"#{row}\">{text}</a></li>\n");
    }
    put!(page, "</ul>\n<p class=\"under\">{}</p>\n", escape(under));
}

/// What is to be known of sentences with figures.
pub const UNDER_HEADLINES: &str =
    "In brackets: intervals with a confidence of 95 %. Each sentence leads to its row.";

/// Charts under a title; no title without one.
pub fn write_figures(page: &mut String, title: &str, figures: &[Figure]) {
    if figures.is_empty() {
        return;
    }
    put!(page, "<h2>{title}</h2>\n<div class=\"charts\">\n");
    for figure in figures {
        let (title, caption) = (escape(&figure.title), escape(&figure.caption));
        put!(
            page,
            "<figure>\n<h3>{title}</h3>\n{}<figcaption>{caption}</figcaption>\n</figure>\n",
            figure.svg
        );
    }
    page.push_str("</div>\n");
}

/// A list of terms with their texts; one without text is left out.
pub fn write_items(page: &mut String, items: &[(&str, String)]) {
    page.push_str("<dl>\n");
    for (name, text) in items.iter().filter(|(_, text)| !text.is_empty()) {
        put!(page, "<dt>{}</dt><dd>{}</dd>\n", escape(name), escape(text));
    }
    page.push_str("</dl>\n");
}

/// On what it was measured, and by what.
pub fn write_machine(page: &mut String, device: &Device, machine: &Machine, program: &Program) {
    let gibibytes = |bytes: u64| format!("{:.1} GiB", bytes as f64 / f64::from(1 << 30));
    let threads = |threads: usize| threads.to_string();
    page.push_str("<h2>Machine</h2>\n");
    let items = [
        ("device", format!("{} ({})", device.name, device.kind)),
        (
            "driver",
            format!("{} {}", device.driver, device.driver_version),
        ),
        ("Vulkan", device.api.clone()),
        ("UUID", device.uuid.clone()),
        ("processor", machine.processor.clone()),
        ("threads", machine.threads.map_or(String::new(), threads)),
        (
            "memory",
            machine.memory_bytes.map_or(String::new(), gibibytes),
        ),
        ("system", machine.system.clone()),
        (
            "program",
            format!("umber {}, revision {}", program.version, program.revision),
        ),
    ];
    write_items(page, &items);
}
