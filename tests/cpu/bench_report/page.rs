//! Is the page whole by itself, well-formed, and honest about what is not there?

use umber::report::{bench_page, headlines};

use super::{report, row};

/// The page as XML, which it is but for its first line.
fn parsed(page: &str) -> roxmltree::Document<'_> {
    let body = page.trim_start().trim_start_matches("<!DOCTYPE html>");
    match roxmltree::Document::parse(body) {
        Ok(document) => document,
        Err(error) => panic!("{error}"),
    }
}

#[test]
fn the_page_needs_nothing_from_elsewhere() {
    let page = bench_page(&report());
    for bad in ["http:", "https:", "<script", "@import", "url("] {
        assert!(!page.contains(bad), "{bad}");
    }
    let document = parsed(&page);
    assert!(
        document
            .descendants()
            .filter(|node| node.has_tag_name("svg"))
            .count()
            >= 2
    );
    assert!(page.contains("prefers-color-scheme"));
}

#[test]
fn every_sentence_leads_to_its_row() {
    let report = report();
    let page = bench_page(&report);
    let document = parsed(&page);
    let ids: Vec<_> = document
        .descendants()
        .filter_map(|node| node.attribute("id"))
        .collect();
    let links: Vec<_> = document
        .descendants()
        .filter(|node| node.has_tag_name("a"))
        .filter_map(|node| node.attribute("href"))
        .collect();
    assert!(links.len() >= headlines(&report).len());
    for link in links {
        let target = link.strip_prefix('#');
        assert!(target.is_some_and(|target| ids.contains(&target)), "{link}");
    }
    for row in &report.rows {
        assert!(page.contains(&row.mode));
    }
}

#[test]
fn what_comes_from_outside_is_text() {
    let mut report = report();
    report.device.name = "<script>alert(1)</script> & \"friends\"".to_owned();
    report.rows[1].note = "<b>'&</b>".to_owned();
    report.machine.processor = "]]> --> <!--".to_owned();
    let page = bench_page(&report);
    assert!(!page.contains("<script") && !page.contains("<b>"));
    assert!(page.contains("&lt;script&gt;"));
    parsed(&page);
}

#[test]
fn figures_that_do_not_exist_are_not_drawn() {
    let mut report = report();
    for row in &mut report.rows {
        row.gpu_ms = None;
        row.creation_cold_ms = None;
        row.relative = row.relative.filter(|relative| *relative > 1.5);
        row.submit_to_idle_ms = Some(0.0);
    }
    report.rows.push(row("nothing", "shuffled", "tiny", 0.0));
    let page = bench_page(&report);
    for bad in ["NaN", "inf", "null"] {
        let plain = page.replace("null:", "");
        assert!(
            !plain.contains(&format!("\"{bad}")) && !plain.contains(&format!(">{bad}<")),
            "{bad}"
        );
    }
    parsed(&page);
    let empty = umber::report::BenchReport {
        rows: Vec::new(),
        break_even: Vec::new(),
        ..report
    };
    parsed(&bench_page(&empty));
}
