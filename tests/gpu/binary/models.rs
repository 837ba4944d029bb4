//! Does `umber models` tell the known figures, and keep its truths?

use serde_json::Value;

use super::{Place, Tested};

/// The range of a figure over a tier's surfaces, percent; gold facets have no published figure.
fn range(report: &Value, term: &str, tier: &str, figure: &str) -> (f64, f64) {
    let rows = report["rows"].as_array().cloned().unwrap_or_default();
    let row = rows
        .iter()
        .find(|row| row["term"] == term && row["tier"] == tier);
    let cases = row.and_then(|row| row["cases"].as_array()).cloned();
    let values: Vec<f64> = cases
        .unwrap_or_default()
        .iter()
        .filter(|case| {
            !case["surface"]
                .as_str()
                .unwrap_or_default()
                .contains("gold")
        })
        .filter_map(|case| Some(case[figure].as_f64()? * 100.0))
        .collect();
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(0.0, f64::max);
    (low, high)
}

/// Published and independent figures: MODELS of the V-cavities with both parameters free, and of the walk at three widths.
#[test]
fn the_known_figures_come_out_and_are_kept() -> Tested {
    let place = Place::empty()?;
    let models = "XDG_CACHE_HOME=$PWD/caches \"$UMBER\" models --paths 16384 --json --quiet";
    let first = place.shell(models)?.ends(0, &[]);
    let report: Value = serde_json::from_slice(&first.stdout)?;
    assert_eq!(report["schema"], "umber.models/1");
    for (term, tier, figure, low, high) in [
        ("diffuse", "qon", "refitted_rms", 8.7, 14.3),
        ("diffuse", "full-oren-nayar", "refitted_rms", 2.6, 5.0),
        ("diffuse", "fon", "refitted_rms", 4.4, 5.6),
        ("diffuse", "eon", "refitted_rms", 3.4, 5.5),
        ("specular", "ggx", "error_rms", 6.9, 60.3),
        ("specular", "ggx-multi", "error_rms", 3.9, 5.8),
    ] {
        let got = range(&report, term, tier, figure);
        // Two simulations, one of 0.7 % and one of 0.3 %, and a decimal.
        let near = |got: f64, want: f64| (got - want).abs() <= 0.4;
        assert!(near(got.0, low) && near(got.1, high), "{tier}: {got:?}");
    }
    let (_, worst) = range(&report, "fresnel", "spectral", "error_max");
    assert!(worst <= 0.2, "{worst}");

    // The truths are at hand now; one that is damaged is made again, and told.
    let kept = place.path("caches/umber/truths/v-cavities-0.35-16384.json");
    let whole = std::fs::read(&kept)?;
    std::fs::write(&kept, &whole[..whole.len() / 2])?;
    let loud = models.replace(" --quiet", "");
    let second = place
        .shell(&loud)?
        .ends(0, &["v-cavities-0.35-16384.json", "made anew"]);
    assert_eq!(second.stdout, first.stdout);
    assert_eq!(std::fs::read(&kept)?, whole);
    Ok(())
}
