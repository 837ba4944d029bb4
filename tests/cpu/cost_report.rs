//! Is the page of a cost report well-formed, whole and safe, and do its sentences say what its rows hold?

use std::collections::BTreeMap;

use umber::report::{
    CostMethod, CostReport, Device, Interval95, LampRow, Machine, Program, PromiseRow, Sample,
    SceneCost, TierRow, cost_page,
};

const BOUNDS: Interval95 = Interval95 {
    low: Some(0.4),
    high: Some(0.7),
};

fn scene(name: &str, flip: f64) -> SceneCost {
    SceneCost {
        scene: name.to_owned(),
        flip_mean: flip,
        flip_p95: flip * 3.0,
        code_max: 12.0,
        first_draw_ms: 80.0,
        frame_ms: Some(20.0),
        of_default: Some(0.9),
        of_default_95: BOUNDS,
        pareto: flip > 0.0 && flip < 0.05,
    }
}

fn row(term: &str, tier: &str, error: f64, of_slides: f64, pareto: bool) -> TierRow {
    TierRow {
        term: term.to_owned(),
        tier: tier.to_owned(),
        model_error_rms: Some(error),
        model_error_max: Some(error * 4.0),
        rounding_error_max: Some(1e-6),
        albedo_error_max: None,
        reciprocity_error_max: None,
        flip_mean: Some(error / 10.0),
        flip_p95: Some(error / 2.0),
        code_max: Some(12.0),
        ns_per_evaluation: Some(of_slides * 6.0),
        ns_mad: Some(0.1),
        of_slides: Some(of_slides),
        of_slides_95: BOUNDS,
        ns_per_fragment: None,
        fragment_of_slides: None,
        fragment_of_slides_95: BOUNDS,
        spirv_instructions: None,
        driver_statistics: BTreeMap::from([("main: Register Count".to_owned(), 64.0)]),
        pareto,
        scenes: vec![scene("<zoo>", error / 10.0), scene("plates", 0.0)],
    }
}

fn report() -> CostReport {
    CostReport {
        schema: CostReport::SCHEMA.to_owned(),
        device: Device {
            name: "<script>&\"llvm'pipe".to_owned(),
            kind: "cpu".to_owned(),
            driver: "driver".to_owned(),
            driver_version: "1".to_owned(),
            api: "1.3".to_owned(),
            uuid: "00".to_owned(),
        },
        machine: Machine::this(),
        method: CostMethod {
            plan: "quick".to_owned(),
            size: (320, 180),
            rounds: 3,
            lamps: 4,
            paths: 1024,
        },
        rows: vec![
            row("diffuse", "lambert", 0.5, -0.01, true),
            row("diffuse", "qon", 0.2, 0.25, true),
            row("diffuse", "slides", 0.2, 0.6, false),
            row("model", "slides", 0.9, 1.0, false),
            row("model", "qon + cook-torrance + schlick", 0.4, 0.55, true),
            row("model", "eon + ggx-multi + spectral", 0.1, 3.1, true),
        ],
        lamps: vec![LampRow {
            tier: "slides".to_owned(),
            lamps: 4,
            ns_per_fragment: 40.0,
            ns_mad: 1.0,
        }],
        promises: vec![
            PromiseRow {
                scene: "<zoo>".to_owned(),
                max_error: 0.05,
                chosen: Some("qon + cook-torrance + schlick".to_owned()),
                flip_mean: 0.04,
                of_default: Some(0.8),
                of_default_95: BOUNDS,
            },
            PromiseRow {
                scene: "<zoo>".to_owned(),
                max_error: 0.005,
                chosen: None,
                flip_mean: 0.01,
                of_default: None,
                of_default_95: BOUNDS,
            },
        ],
        program: Program::this(),
    }
}

fn samples() -> Vec<Sample> {
    let sample = |tier: &str, flip_mean| Sample {
        scene: "<zoo>".to_owned(),
        tier: tier.to_owned(),
        flip_mean,
        png: b"\x89PNG".to_vec(),
    };
    vec![sample("reference, f64", None), sample("slides", Some(0.09))]
}

#[test]
fn the_page_is_well_formed_and_every_link_leads_somewhere() {
    let page = cost_page(&report(), &samples());
    let body = page.split_once('\n').map_or("", |(_, rest)| rest);
    let parsed = roxmltree::Document::parse(body).expect("well-formed");
    let all = || parsed.descendants();
    assert!(!all().any(|node| node.has_tag_name("script")));
    let ids: Vec<_> = all().filter_map(|node| node.attribute("id")).collect();
    let links: Vec<_> = all().filter_map(|node| node.attribute("href")).collect();
    assert!(links.len() > 10, "{links:?}");
    for link in links {
        assert!(ids.contains(&link.trim_start_matches('#')), "{link}");
    }
    let pictures: Vec<_> = all()
        .filter(|node| node.has_tag_name("img"))
        .filter_map(|node| node.attribute("src"))
        .collect();
    assert_eq!(pictures, ["data:image/png;base64,iVBORw=="; 2]);
    let text: String = all().filter_map(|node| node.text()).collect();
    for words in [
        "take 0.55 (0.40 to 0.70) of the listings' time",
        "by the listings, 0.0100 by the default model",
        "Nearest matte base: qon, 20.00 % off",
        "beaten in error and time: slides",
        "Of 2 promises",
        "none keeps it",
        "0.0900  slides",
        "A CPU shades",
    ] {
        assert!(text.contains(words), "{words}");
    }
}

#[test]
fn a_report_without_rows_still_is_a_page() {
    let mut empty = report();
    empty.rows.clear();
    empty.lamps.clear();
    empty.promises.clear();
    let page = cost_page(&empty, &[]);
    let body = page.split_once('\n').map_or("", |(_, rest)| rest);
    assert!(roxmltree::Document::parse(body).is_ok());
    assert!(!page.contains("<h2>Pictures"));
}

#[test]
fn the_table_marks_the_front() {
    let table = report().table();
    for words in [
        "lambert *",
        "qon *",
        "eon + ggx-multi + spectral *",
        "0.55 (0.40 to 0.70)",
    ] {
        assert!(table.contains(words), "{words}: {table}");
    }
    assert!(!table.contains("slides *"), "{table}");
}
