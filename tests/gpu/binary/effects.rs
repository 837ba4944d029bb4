//! Does `umber effects` tell who calls for what, at which price, in the layout that it promises?

use serde_json::Value;

use super::{Place, Tested};

fn report(place: &Place, arguments: &[&str]) -> Result<Value, Box<dyn std::error::Error>> {
    let common = [
        "effects",
        "--validation",
        "--quiet",
        "--json",
        "--size",
        "32x18",
    ];
    let run = place.umber(&[&common, arguments].concat())?.ends(0, &[]);
    Ok(serde_json::from_slice(&run.stdout)?)
}

fn row<'a>(report: &'a Value, effect: &str) -> &'a Value {
    let rows = report["rows"].as_array().into_iter().flatten();
    let mut named = rows.filter(|row| row["effect"] == effect);
    named.next().unwrap_or(&Value::Null)
}

#[test]
fn each_effect_has_a_row_with_its_callers_and_its_price() -> Tested {
    let place = Place::new()?;
    let report = report(&place, &["scene.toml", "--rounds", "6"])?;
    assert_eq!(report["schema"], "umber.effects/1");
    assert!(report["device"]["name"].is_string());
    assert!(report["program"]["clock"].is_string());
    assert_eq!(
        (&report["width"], &report["rounds"]),
        (&32.into(), &6.into())
    );
    assert_eq!(report["rows"].as_array().map(Vec::len), Some(17));

    let called_for = row(&report, "rough-diffuse");
    assert_eq!(called_for["scene"], "scene.toml");
    assert_eq!(called_for["called_for_by"][0], "material \"plaster\"");
    for key in ["frame_ms_with", "frame_ms_without"] {
        assert!(
            called_for[key].as_f64().is_some_and(|ms| ms > 0.0),
            "{key}: {called_for}"
        );
    }
    let (cost, bounds) = (&called_for["cost_ms"], &called_for["cost_ms_95"]);
    assert!(bounds["low"].as_f64() <= cost.as_f64() && cost.as_f64() <= bounds["high"].as_f64());

    let nobody = row(&report, "spot-light");
    assert_eq!(nobody["called_for_by"].as_array().map(Vec::len), Some(0));
    assert!(nobody["frame_ms_with"].is_null() && nobody["cost_ms"].is_null());
    assert!(nobody["unused_cost_percent"].is_f64());
    Ok(())
}

#[test]
fn each_build_has_a_row_with_its_first_draws_and_its_difference() -> Tested {
    let place = Place::new()?;
    let report = report(
        &place,
        &["scene.toml", "--rounds", "2", "--only", "emission"],
    )?;
    assert_eq!(report["rows"].as_array().map(Vec::len), Some(1));
    let builds = report["builds"].as_array().cloned().unwrap_or_default();
    let names: Vec<_> = builds.iter().map(|row| row["build"].clone()).collect();
    assert_eq!(names, ["dynamic", "scene", "material"]);
    for build in &builds {
        for key in ["first_draw_cold_ms", "first_draw_warm_ms", "frame_ms"] {
            assert!(
                build[key].as_f64().is_some_and(|ms| ms > 0.0),
                "{key}: {build}"
            );
        }
        assert!(
            build["max_difference"].as_f64().is_some_and(|d| d <= 1e-5),
            "{build}"
        );
        // Two rounds bound nothing.
        assert!(build["relative_95"]["low"].is_null());
    }
    assert_eq!(builds[1]["relative"], 1.0);
    Ok(())
}

#[test]
fn the_table_names_callers_and_nobody() -> Tested {
    let place = Place::new()?;
    let arguments = ["effects", "scene.toml", "--size", "16x9", "--rounds", "1"];
    let run = place.umber(&arguments)?.ends(0, &[]);
    let table = String::from_utf8_lossy(&run.stdout).into_owned();
    for words in [
        "diffuse-lobe",
        "material \"plaster\"",
        "nobody",
        "first draw cold",
        "material ",
    ] {
        assert!(table.contains(words), "{words}: {table}");
    }
    Ok(())
}

#[test]
fn a_price_list_takes_each_effect_from_the_scene_of_its_name() -> Tested {
    let place = Place::new()?;
    std::fs::rename(place.path("scene.toml"), place.path("rough-diffuse.toml"))?;
    let report = report(
        &place,
        &[
            "--price-list",
            ".",
            "--only",
            "rough-diffuse",
            "--rounds",
            "1",
        ],
    )?;
    assert_eq!(report["rows"].as_array().map(Vec::len), Some(1));
    assert_eq!(report["builds"].as_array().map(Vec::len), Some(0));
    assert_eq!(
        row(&report, "rough-diffuse")["scene"],
        "./rough-diffuse.toml"
    );
    place
        .umber(&["effects", "--price-list", ".", "--only", "emission"])?
        .ends(6, &["emission.toml", "no such file"]);
    Ok(())
}

#[test]
fn what_is_asked_wrongly_ends_with_2() -> Tested {
    let place = Place::new()?;
    let cases: &[(&[&str], &str)] = &[
        (&[], "SCENES"),
        (&["scene.toml", "--only", "shadows"], "'shadow'"),
        (&["scene.toml", "--only", ""], "diffuse-lobe"),
        (&["scene.toml", "--rounds", "0"], "rounds"),
        (&["scene.toml", "--json=./scene.toml"], "overwritten"),
        (&["scene.toml", "--price-list", "."], "price-list"),
        (&["scene.toml", "--size", "0x9"], "at least one pixel"),
        (&["scene.toml", "--size", "1000000x9"], "at most"),
    ];
    for (arguments, expected) in cases {
        let run = place.umber(&[&["effects"], *arguments].concat())?;
        assert!(run.ends(2, &[expected]).stdout.is_empty(), "{arguments:?}");
    }
    Ok(())
}

#[test]
fn render_has_what_is_left_of_the_effects() -> Tested {
    let place = Place::new()?;
    let size = ["--size", "16x9", "--samples", "1"];
    let picture = |name: &str, arguments: &[&str]| -> Result<Vec<u8>, Box<dyn std::error::Error>> {
        let all = [&["scene.toml", "-o", name][..], &size, arguments].concat();
        place.render(&all)?.ends(0, &[]);
        Ok(std::fs::read(place.path(name))?)
    };
    let census = picture("census.exr", &[])?;
    assert_eq!(picture("named.exr", &["--effects", "census"])?, census);
    assert_ne!(picture("none.exr", &["--effects", "none"])?, census);
    let lobe = picture("lobe.exr", &["--effects", "diffuse-lobe"])?;
    assert_ne!(lobe, census);
    let both = ["--effects", "diffuse-lobe,two-sided"];
    assert_eq!(picture("both.exr", &both)?, lobe);
    for arguments in [
        ["--effects", "fog"],
        ["--effects", "shadows"],
        ["--build", "fast"],
    ] {
        let all = [&["scene.toml"][..], &arguments].concat();
        place.render(&all)?.ends(2, &[arguments[0]]);
    }
    Ok(())
}
