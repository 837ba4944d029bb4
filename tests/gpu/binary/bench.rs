//! Does `umber bench` measure, keep and compare as it promises, and refuse what it cannot?

use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::Value;

use super::{Place, Tested, UMBER};

/// A small bench of two modes under the layers.
const SMALL: [&str; 12] = [
    "bench",
    "--validation",
    "--quiet",
    "--skip-creation",
    "--mode",
    "one-pipeline,pipeline-per-material",
    "--materials",
    "3",
    "--draws",
    "12",
    "--rounds",
    "6",
];

fn json(place: &Place, name: &str) -> Result<Value, Box<dyn std::error::Error>> {
    Ok(serde_json::from_slice(&std::fs::read(place.path(name))?)?)
}

fn rows(report: &Value) -> Vec<Value> {
    report["rows"].as_array().cloned().unwrap_or_default()
}

#[test]
fn every_row_has_what_the_layout_promises() -> Tested {
    let place = Place::empty()?;
    let run = place
        .umber(&[&SMALL[..], &["--json"]].concat())?
        .ends(0, &[]);
    let report: Value = serde_json::from_slice(&run.stdout)?;
    assert_eq!(report["schema"], "umber.bench/1");
    assert!(report["device"]["name"].is_string() && report["machine"]["threads"].is_u64());
    assert_eq!(report["method"]["plan"], "custom");
    let rows = rows(&report);
    // Both modes in both orders.
    assert_eq!(rows.len(), 4);
    for row in &rows {
        for key in [
            "record_ns_per_draw",
            "record_mad",
            "submit_to_idle_ms",
            "gpu_ms",
            "relative",
        ] {
            assert!(row[key].as_f64().is_some_and(|x| x >= 0.0), "{key}: {row}");
        }
        assert_eq!((&row["samples"], &row["draws"]), (&6.into(), &12.into()));
        assert_eq!(
            (&row["scene"], &row["materials"]),
            (&"tiny".into(), &3.into())
        );
        assert!(row["creation_cold_ms"].is_null() && row["note"].is_string());
        assert_eq!(row["image_hash"].as_str().map(str::len), Some(16));
    }
    let switching = rows
        .iter()
        .find(|r| r["mode"] == "pipeline-per-material" && r["order"] == "sorted");
    assert_eq!(switching.map(|row| &row["pipeline_binds"]), Some(&3.into()));
    Ok(())
}

#[test]
fn creation_is_measured_in_processes_of_its_own() -> Tested {
    let place = Place::empty()?;
    let arguments = [
        "bench",
        "--quiet",
        "--mode",
        "one-pipeline",
        "--materials",
        "2",
    ];
    let rest = ["--draws", "4", "--rounds", "1", "--json=out.json"];
    place.umber(&[&arguments[..], &rest].concat())?.ends(0, &[]);
    for row in rows(&json(&place, "out.json")?) {
        for key in ["creation_cold_ms", "creation_warm_ms"] {
            assert!(row[key].as_f64().is_some_and(|ms| ms > 0.0), "{key}: {row}");
        }
    }
    Ok(())
}

#[test]
fn the_same_rows_go_to_the_table_to_csv_and_to_a_page() -> Tested {
    let place = Place::empty()?;
    place
        .umber(&[&SMALL[..], &["--json=out.json"]].concat())?
        .ends(0, &[]);
    let read = [
        "bench", "--read", "out.json", "--csv", "out.csv", "--report", "out.html",
    ];
    let run = place.umber(&read)?.ends(0, &[]);
    let table = String::from_utf8(run.stdout)?;
    assert!(table.contains("pipeline-per-material"), "{table}");
    let csv = std::fs::read_to_string(place.path("out.csv"))?;
    assert_eq!(csv.lines().count(), 5, "{csv}");
    let page = std::fs::read_to_string(place.path("out.html"))?;
    assert!(page.contains("<svg") && page.contains("pipeline-per-material"));
    Ok(())
}

#[test]
fn a_run_that_is_killed_keeps_its_cells_and_goes_on() -> Tested {
    let place = Place::empty()?;
    let arguments = [&SMALL[..8], &["--draws", "4,8,12,300000", "--rounds", "3"]].concat();
    let mut run = Command::new(UMBER)
        .current_dir(place.folder.path())
        .args([&arguments[..], &["--json=out.json"]].concat())
        .stdout(Stdio::null())
        .spawn()?;
    let start = Instant::now();
    let kept = loop {
        if let Ok(report) = json(&place, "out.json") {
            break rows(&report);
        }
        assert!(
            start.elapsed() < Duration::from_secs(120),
            "nothing is kept"
        );
        std::thread::sleep(Duration::from_millis(5));
    };
    run.kill()?;
    run.wait()?;
    let kept = match json(&place, "out.json") {
        Ok(report) => rows(&report),
        Err(_) => kept,
    };
    assert!(!kept.is_empty() && kept.len() < 16, "{} rows", kept.len());

    // A plan of its own that is smaller than the one that was killed.
    let smaller = [
        &SMALL[..8],
        &["--draws", "4,8,12", "--rounds", "3", "--resume", "out.json"],
    ]
    .concat();
    place.umber(&smaller)?.ends(0, &[]);
    let all = rows(&json(&place, "out.json")?);
    assert!(all.len() >= 12, "{} rows", all.len());
    assert_eq!(all[..kept.len()], kept);
    let key = |row: &Value| ["mode", "order", "draws"].map(|key| row[key].to_string());
    for (i, row) in all.iter().enumerate() {
        assert!(row["relative"].is_f64(), "{row}");
        assert!(
            all[..i].iter().all(|before| key(before) != key(row)),
            "twice: {row}"
        );
    }
    Ok(())
}

#[test]
fn another_run_does_not_go_on() -> Tested {
    let place = Place::empty()?;
    place
        .umber(&[&SMALL[..], &["--json=out.json"]].concat())?
        .ends(0, &[]);
    let other = [&SMALL[..], &["--seed", "2", "--resume", "out.json"]].concat();
    place.umber(&other)?.ends(2, &["out.json", "seed"]);
    Ok(())
}

/// Writes out.json, and old.json with its ratios and times divided by `factor`.
fn with_baseline(place: &Place, factor: f64) -> Tested {
    place
        .umber(&[&SMALL[..], &["--json=out.json"]].concat())?
        .ends(0, &[]);
    let mut old = json(place, "out.json")?;
    let rows = old["rows"].as_array_mut().into_iter().flatten();
    for row in rows {
        for key in ["record_ns_per_draw", "record_mad"] {
            row[key] = row[key].as_f64().map(|x| x / factor).into();
        }
    }
    place.write("old.json", &old.to_string())?;
    Ok(())
}

#[test]
fn a_baseline_tells_what_grew() -> Tested {
    let place = Place::empty()?;
    with_baseline(&place, 100.0)?;
    let against = ["bench", "--read", "out.json", "--baseline", "old.json"];
    let run = place.umber(&against)?.ends(1, &["record_ns_per_draw"]);
    assert!(!run.stdout.is_empty());
    place
        .umber(&[&against[..], &["--threshold", "1000"]].concat())?
        .ends(0, &[]);
    // Against itself nothing changed.
    let itself = ["bench", "--read", "out.json", "--baseline", "out.json"];
    place.umber(&itself)?.ends(0, &["100.0 %"]);
    Ok(())
}

#[test]
fn a_baseline_of_another_layout_or_device_is_refused() -> Tested {
    let place = Place::empty()?;
    with_baseline(&place, 1.0)?;
    let mut other = json(&place, "old.json")?;
    other["device"]["name"] = "another".into();
    place.write("device.json", &other.to_string())?;
    other["schema"] = "umber.bench/0".into();
    place.write("schema.json", &other.to_string())?;
    place.write("text.json", "no report")?;
    let against = |name| place.umber(&["bench", "--read", "out.json", "--baseline", name]);
    against("device.json")?.ends(2, &["another"]);
    against("schema.json")?.ends(6, &["schema.json", "umber.bench/0"]);
    against("text.json")?.ends(6, &["text.json"]);
    against("absent.json")?.ends(6, &["absent.json"]);
    Ok(())
}

#[test]
fn what_cannot_be_measured_is_refused_before_anything_is() -> Tested {
    let place = Place::empty()?;
    let refused = |arguments: &[&str], parts: &[&str]| -> Tested {
        let arguments = [&["bench", "--quiet", "--skip-creation"][..], arguments].concat();
        place.umber(&arguments)?.ends(2, parts);
        Ok(())
    };
    refused(&["--draws", "0"], &["--draws", "1"])?;
    refused(&["--materials", "0"], &["--materials"])?;
    refused(&["--mode", "instance"], &["instance", "instanced"])?;
    refused(&["--scene", "huge"], &["huge", "tiny"])?;
    refused(&["--draws", "100000000"], &["10000000"])?;
    refused(&["--draws", "10000000"], &["10000000", "draws"])?;
    refused(&["--quick", "--full"], &["--full"])?;
    refused(&["--json=a", "--csv", "a"], &["a", "twice"])?;
    assert!(!place.path("a").exists());
    Ok(())
}

#[test]
fn recorded_and_reset_is_a_method() -> Tested {
    let place = Place::empty()?;
    let arguments = [
        "bench",
        "--quiet",
        "--method",
        "vkoverhead",
        "--mode",
        "one-pipeline",
    ];
    let rest = ["--materials", "2", "--rounds", "2", "--json"];
    let run = place.umber(&[&arguments[..], &rest].concat())?.ends(0, &[]);
    let report: Value = serde_json::from_slice(&run.stdout)?;
    assert_eq!(report["method"]["name"], "vkoverhead");
    for row in rows(&report) {
        assert_eq!(
            (&row["scene"], &row["draws"]),
            (&"null".into(), &10_000.into())
        );
        assert!(row["record_ns_per_draw"].is_f64() && row["submit_to_idle_ms"].is_null());
    }
    Ok(())
}
