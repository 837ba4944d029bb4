//! Does `umber cost` give its rows, and does `umber render` keep what it promises?

use std::path::Path;

use serde_json::Value;

use super::{Place, Tested};

fn sample(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("scenes")
        .join(name);
    path.display().to_string()
}

/// Every column of a row that `--quick` fills.
const FILLED: [&str; 8] = [
    "model_error_rms",
    "flip_mean",
    "flip_p95",
    "code_max",
    "ns_per_evaluation",
    "ns_mad",
    "of_slides",
    "pareto",
];

#[test]
fn the_rows_are_whole_and_every_promise_held() -> Tested {
    let place = Place::empty()?;
    let scene = sample("effects/rough-diffuse.toml");
    let command = [
        "cost",
        &scene,
        "--validation",
        "--size",
        "64x36",
        "--rounds",
        "1",
    ];
    let command = [
        &command[..],
        &["--json=cost.json", "--report", "cost.html", "--quiet"],
    ]
    .concat();
    place.umber(&command)?.ends(0, &[]);
    let report: Value = serde_json::from_slice(&std::fs::read(place.path("cost.json"))?)?;
    assert_eq!(report["schema"], "umber.cost/1");
    let rows = report["rows"].as_array().cloned().unwrap_or_default();
    let of = |term: &'static str| rows.iter().filter(move |row| row["term"] == term);
    let counts = ["diffuse", "specular", "fresnel"].map(|term| of(term).count());
    assert_eq!(counts, [6, 7, 6]);
    assert!(of("model").count() >= 20, "{}", of("model").count());
    for row in &rows {
        for column in FILLED {
            assert!(!row[column].is_null(), "{column}: {row}");
        }
    }
    for term in ["diffuse", "specular", "fresnel", "model"] {
        assert!(of(term).any(|row| row["pareto"] == true), "{term}");
        assert!(of(term).any(|row| row["pareto"] == false), "{term}");
    }
    let promises = report["promises"].as_array().cloned().unwrap_or_default();
    assert_eq!(promises.len(), 4);
    for promise in promises {
        let (flip, most) = (promise["flip_mean"].as_f64(), promise["max_error"].as_f64());
        let (flip, most) = (flip.unwrap_or(1.0), most.unwrap_or(0.0));
        assert_eq!(promise["chosen"].is_null(), flip > most, "{promise}");
    }
    let page = std::fs::read_to_string(place.path("cost.html"))?;
    assert!(page.contains("data:image/png;base64,"));
    Ok(())
}

#[test]
fn a_promise_picks_a_model_and_is_kept() -> Tested {
    let place = Place::empty()?;
    let scene = sample("effects/rough-diffuse.toml");
    let picked = |promise: &[&str]| -> Result<Value, Box<dyn std::error::Error>> {
        let command = [
            &[scene.as_str(), "--size", "160x90", "--json", "--quiet"],
            promise,
        ]
        .concat();
        let report: Value = serde_json::from_slice(&place.render(&command)?.ends(0, &[]).stdout)?;
        Ok(report["choice"].clone())
    };
    let choice = picked(&["--max-error", "0.02", "--output", "cheap.exr"])?;
    let flip = choice["flip_mean"].as_f64().unwrap_or(1.0);
    assert!(flip <= 0.02, "{choice}");
    assert!(
        choice["ns_of_default"].as_f64().unwrap_or(2.0) < 1.0,
        "{choice}"
    );
    // What was written is the picture of the model that was named.
    let names: Vec<String> = choice["lighting"]
        .as_str()
        .unwrap_or_default()
        .split(" + ")
        .map(str::to_owned)
        .collect();
    let [diffuse, specular, fresnel] = &names[..] else {
        panic!("{choice}");
    };
    let tiers = [
        "--diffuse",
        diffuse,
        "--specular",
        specular,
        "--fresnel",
        fresnel,
    ];
    let plain = ["--size", "160x90", "--quiet", "--output", "same.exr"];
    place
        .render(&[&[scene.as_str()][..], &plain, &tiers].concat())?
        .ends(0, &[]);
    let (cheap, same) = (place.path("cheap.exr"), place.path("same.exr"));
    assert_eq!(std::fs::read(cheap)?, std::fs::read(same)?);
    let choice = picked(&["--budget-ms", "60000"])?;
    assert_eq!(choice["budget_ms"], 60000.0);
    assert!(choice["frame_ms"].as_f64().unwrap_or(1e9) <= 60000.0);
    Ok(())
}

/// Where nothing shines the cheapest model is right.
#[test]
fn a_scene_without_a_light_has_a_model_too() -> Tested {
    let place = Place::empty()?;
    let dark = "[model.square]\nshape = \"plane\"\n[ambient]\nsky = 0\nground = 0\n\
                [light.lamp]\nkind = \"directional\"\ndirection = [0, -1, 0]\nilluminance = 0\n";
    place.write("dark.toml", dark)?;
    let run = place.render(&["dark.toml", "--size", "32x18", "--max-error", "0", "--json"])?;
    let run = run.ends(0, &["it differs by 0.0000", "light.lamp gives no light"]);
    let report: Value = serde_json::from_slice(&run.stdout)?;
    assert_eq!(report["choice"]["flip_mean"], 0.0);
    Ok(())
}

#[test]
fn what_cannot_be_promised_is_refused() -> Tested {
    let place = Place::new()?;
    let wrong = [
        (["--max-error", "-1"], "it is a number from 0 to 1"),
        (["--max-error", "2"], "it is a number from 0 to 1"),
        (["--budget-ms", "0"], "above 0"),
    ];
    for (arguments, words) in wrong {
        place
            .render(&[&["scene.toml"], &arguments[..]].concat())?
            .ends(2, &[words]);
    }
    let both = ["scene.toml", "--max-error", "0.1", "--lighting", "phong"];
    place.render(&both)?.ends(2, &["--max-error", "--lighting"]);
    let both = ["scene.toml", "--max-error", "0.1", "--budget-ms", "1"];
    place.render(&both)?.ends(2, &["cannot be used with"]);
    let never = ["scene.toml", "--size", "16x9", "--budget-ms", "0.000001"];
    place.render(&never)?.ends(
        1,
        &["no model draws this scene in 0.000001 ms", "ask for more"],
    );
    assert_eq!(place.names()?, ["scene.toml"]);
    Ok(())
}

#[test]
fn scenes_that_are_none_and_places_that_are_taken_are_refused() -> Tested {
    let place = Place::new()?;
    place.umber(&["cost", "none.toml"])?.ends(6, &["none.toml"]);
    place
        .umber(&["cost", "scene.toml", "--report", "scene.toml"])?
        .ends(2, &["scene.toml"]);
    place
        .umber(&["cost", "scene.toml", "--quick", "--full"])?
        .ends(2, &["--full"]);
    place
        .umber(&["cost", "scene.toml", "--size", "0x1"])?
        .ends(2, &["at least one pixel"]);
    assert_eq!(place.names()?, ["scene.toml"]);
    Ok(())
}
