//! Is the page of a stability report well-formed, whole and safe from what a driver calls itself?

use proptest::prelude::*;
use umber::report::{
    BitsMap, CostRow, Device, Interval95, Machine, Program, StabilityReport, StabilityRow,
    read_stability, stability_beside, stability_page,
};

fn row(function: &str, case: &str, nan: u64, of_bound: f64) -> StabilityRow {
    StabilityRow {
        function: function.to_owned(),
        tier: "f32".to_owned(),
        case: case.to_owned(),
        inputs: 1234,
        judged: 1000,
        nan,
        inf: 0,
        negative: 0,
        max_relative_error: Some(1e-6),
        mean_relative_error: Some(1e-7),
        max_of_bound: Some(of_bound),
        max_ulp: Some(7.0),
        max_bits_lost: Some(3.0),
        worst_input: Some("0,1,0 = 00000000".to_owned()),
    }
}

fn report() -> StabilityReport {
    StabilityReport {
        schema: StabilityReport::SCHEMA.to_owned(),
        device: Device {
            name: "<script>&\"llvm'pipe".to_owned(),
            kind: "cpu".to_owned(),
            driver: "driver".to_owned(),
            driver_version: "1".to_owned(),
            api: "1.3".to_owned(),
            uuid: "00".to_owned(),
        },
        machine: Machine::this(),
        plan: "quick".to_owned(),
        seed: 1,
        evaluations: 4 * 1234,
        rows: vec![
            row("oren-nayar", "generic", 0, 0.2),
            row("oren-nayar", "headlight", 0, 0.7),
            row("slides-oren-nayar", "generic", 0, 3.0),
            row("slides-oren-nayar", "headlight", 5, 1.0),
        ],
        costs: vec![CostRow {
            function: "oren-nayar".to_owned(),
            tier: "f32".to_owned(),
            listing: "slides-oren-nayar".to_owned(),
            ns: 1.5,
            listing_ns: 3.0,
            relative: 0.5,
            relative_95: Interval95 {
                low: Some(0.4),
                high: None,
            },
        }],
        maps: vec![BitsMap {
            function: "oren-nayar".to_owned(),
            tier: "f32".to_owned(),
            roughness: vec![1e-4, 1.0],
            degrees: vec![0.0, 89.5],
            bits: vec![vec![Some(2.0), None], vec![None, Some(20.0)]],
            bad: vec![vec![0, 0], vec![3, 0]],
        }],
        program: Program::this(),
    }
}

fn bytes(report: &StabilityReport) -> Vec<u8> {
    serde_json::to_vec(report).expect("serialises")
}

#[test]
fn each_function_is_summed_up_and_its_worst_row_found() {
    let summaries = report().summaries();
    assert_eq!(summaries.len(), 2);
    assert_eq!((summaries[0].inputs, summaries[0].row), (2468, 1));
    assert_eq!(summaries[0].of_bound, Some(0.7));
    assert_eq!(
        summaries[1].of_bound, None,
        "of a listing nothing is promised"
    );
    // One that is no number is worse than any error.
    assert_eq!((summaries[1].nan, summaries[1].row), (5, 3));
    assert_eq!(
        report().broken().count(),
        0,
        "of a listing nothing is promised"
    );
    let mut broken = report();
    broken.rows[0].negative = 1;
    broken.rows[1].max_of_bound = Some(1.5);
    assert_eq!(broken.broken().count(), 2);
}

#[test]
fn the_page_is_well_formed_and_every_link_leads_somewhere() {
    let page = stability_page(&report(), None);
    let body = page.split_once('\n').map_or("", |(_, rest)| rest);
    let parsed = roxmltree::Document::parse(body).expect("well-formed");
    let all = || parsed.descendants();
    assert!(!all().any(|node| node.has_tag_name("script")));
    let ids: Vec<_> = all().filter_map(|node| node.attribute("id")).collect();
    let links: Vec<_> = all().filter_map(|node| node.attribute("href")).collect();
    // The sentences on the library and the listing, and the two lines of the table.
    assert_eq!(links, ["#row-1", "#row-3", "#row-1", "#row-3"]);
    for link in links {
        assert!(ids.contains(&link.trim_start_matches('#')), "{link}");
    }
    let class = |class: &str| {
        let map = all().find(|node| node.attribute("class") == Some("maps"));
        map.map_or(0, |map| {
            let cells = map.descendants();
            cells
                .filter(|node| node.attribute("class") == Some(class))
                .count()
        })
    };
    assert_eq!(
        (class("heat-0"), class("heat-7"), class("heat-bad")),
        (1, 1, 1)
    );
    let text: String = all().filter_map(|node| node.text()).collect();
    for words in [
        "5 NaN",
        "4,936 in all",
        "0.50 [0.40, -]",
        "The library, 1 function: no NaN, infinity or negative value in 2,468 values; the nearest to its bound, \
         oren-nayar in f32, comes to 70 % of it.",
        "slides-oren-nayar, f32: 5 NaN, 0 infinite and 0 negative of 2,468 values",
    ] {
        assert!(text.contains(words), "{words}");
    }
}

#[test]
fn a_cost_is_told_where_both_its_bounds_are_known() {
    let told = |report: &StabilityReport| {
        stability_page(report, None)
            .contains("oren-nayar in f32 costs 0.50 (0.40 to 0.60) of slides-oren-nayar.")
    };
    let mut bounded = report();
    assert!(!told(&bounded));
    bounded.costs[0].relative_95.high = Some(0.6);
    assert!(told(&bounded));
}

/// JSON has no infinity: where the truth is nothing and the value is not, the figure is missing.
#[test]
fn what_is_infinitely_far_off_breaks_its_promise() {
    let mut broken = report();
    broken.rows[1].max_of_bound = None;
    let again = read_stability(&bytes(&broken)).expect("a report");
    assert_eq!(again.broken().count(), 1);
    let page = stability_page(&again, None);
    assert!(page.contains("oren-nayar in f32 passes its bound: inf of it"));
    broken.rows[1].judged = 0;
    assert_eq!(broken.broken().count(), 0);
}

#[test]
fn a_report_that_was_read_again_breaks_the_same_promises() {
    let mut broken = report();
    broken.rows[1].max_of_bound = Some(1.5);
    let again = read_stability(&bytes(&broken)).expect("a report");
    assert_eq!(again, broken);
    assert_eq!(again.broken().count(), 1);
    assert!(
        stability_page(&again, None).contains("oren-nayar in f32 passes its bound: 1.500 of it")
    );
}

#[test]
fn the_table_has_a_line_for_every_row() {
    let table = report().table(" (a CPU)");
    for words in [
        "(a CPU)",
        "oren-nayar, f32:",
        "headlight",
        "1,234",
        "all cases:",
        "2,468",
        "of listing",
    ] {
        assert!(table.contains(words), "{words}: {table}");
    }
}

#[test]
fn what_another_device_makes_of_it_is_told() {
    let mut other = report();
    other.device.name = "other & co".to_owned();
    other.rows[3].nan = 1_110;
    let table = stability_beside(&report(), &other);
    let cells = |whose: &str| {
        let mut lines = table.lines().filter(|line| line.starts_with(whose));
        let line = lines.find(|line| line.contains("f32")).unwrap_or_default();
        line.split_whitespace()
            .map(str::to_owned)
            .collect::<Vec<_>>()
    };
    assert_eq!(cells("here")[..4], ["here", "f32", "2,468", "5"]);
    assert_eq!(cells("there")[..4], ["there", "f32", "2,468", "1,110"]);
    assert!(
        table.contains("Of 2 functions in their tiers that both have, 1 have"),
        "{table}"
    );
    let page = stability_page(&report(), Some(&other));
    let body = page.split_once('\n').map_or("", |(_, rest)| rest);
    let parsed = roxmltree::Document::parse(body).expect("well-formed");
    let text: String = parsed
        .descendants()
        .filter_map(|node| node.text())
        .collect();
    for words in ["other & co", "1,110"] {
        assert!(text.contains(words), "{words}");
    }
    // Beside itself nothing differs.
    let same = stability_beside(&report(), &report());
    assert!(
        same.contains("both have, 0 have") && same.lines().count() == 1,
        "{same}"
    );
}

#[test]
fn what_no_run_would_have_written_is_refused() {
    let refused = |change: &dyn Fn(&mut StabilityReport), part: &str| {
        let mut report = report();
        change(&mut report);
        let message = match read_stability(&bytes(&report)) {
            Ok(_) => String::new(),
            Err(error) => error.to_string(),
        };
        let told = message.contains(part) && message.contains("umber stability --json=FILE");
        assert!(told, "{part}: {message}");
    };
    refused(&|r| r.schema = "umber.bench/1".into(), "umber.bench/1");
    refused(&|r| r.rows[1].nan = 1235, "rows[1]: nan");
    refused(
        &|r| (r.rows[1].nan, r.rows[1].inf, r.rows[1].negative) = (500, 500, 500),
        "together",
    );
    refused(&|r| r.rows[2].inputs = u64::MAX, "rows[2]: inputs");
    refused(&|r| r.rows[0].max_of_bound = Some(-1.0), "max_of_bound");
    refused(&|r| r.rows[0].case = "a\u{1b}[31m".into(), "case");
    refused(
        &|r| r.rows[0].worst_input = Some("x".repeat(100_000)),
        "worst_input",
    );
    refused(&|r| r.evaluations = 1, "evaluations");
    refused(&|r| r.costs[0].relative = 1e300, "costs[0]: relative");
    refused(
        &|r| r.costs[0].relative_95.high = Some(0.1),
        "relative_95 runs from",
    );
    refused(&|r| r.maps[0].bits[1].truncate(1), "maps[0]: its cells");
    refused(&|r| r.maps[0].bad.truncate(1), "maps[0]: its cells");
    refused(&|r| r.maps[0].degrees[0] = 1e9, "maps[0]: degrees");
    refused(&|r| r.device.name = "a\nb".into(), "device.name");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn no_damage_makes_reader_or_page_panic(place in 0_usize..4000, byte: u8) {
        let mut bytes = bytes(&report());
        let place = place % bytes.len();
        bytes[place] = byte;
        if let Ok(damaged) = read_stability(&bytes) {
            let _ = damaged.table("");
            let _ = stability_page(&damaged, Some(&report()));
            let _ = stability_beside(&report(), &damaged);
        }
    }
}
