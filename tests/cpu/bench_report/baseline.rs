//! Is an earlier report read as it was, or refused; and is it told what changed?

use proptest::prelude::*;
use umber::report::{BenchReport, compare, read_bench};

use super::{Tested, interval, report};

fn bytes(report: &BenchReport) -> Result<Vec<u8>, serde_json::Error> {
    serde_json::to_vec(report)
}

#[test]
fn a_report_comes_back_as_it_was() -> Tested {
    let report = report();
    assert_eq!(read_bench(&bytes(&report)?)?, report);
    Ok(())
}

#[test]
fn what_no_bench_would_have_written_is_refused() -> Tested {
    let refused = |change: &dyn Fn(&mut BenchReport), part: &str| -> Tested {
        let mut report = report();
        change(&mut report);
        let message = match read_bench(&bytes(&report)?) {
            Ok(_) => String::new(),
            Err(error) => error.to_string(),
        };
        assert!(
            message.contains(part) && message.contains("umber bench"),
            "{part}: {message}"
        );
        Ok(())
    };
    refused(&|r| r.schema = "umber.bench/2".into(), "umber.bench/2")?;
    refused(&|r| r.rows[2].submit_to_idle_ms = Some(-1.0), "rows[2]")?;
    refused(
        &|r| r.rows[1].relative_95 = Some(interval(2.0, 1.0)),
        "relative_95",
    )?;
    refused(&|r| r.rows[0].draws = u32::MAX, "draws")?;
    refused(&|r| r.rows[0].mode = "a\u{1b}[31m".into(), "mode")?;
    refused(&|r| r.device.name = "a\nb".into(), "device.name")?;
    refused(&|r| r.rows[0].note = "x".repeat(100_000), "note")?;
    for text in [
        "",
        "[]",
        "{}",
        "{\"schema\": 1}",
        "null",
        "{\"schema\":\"umber.bench/1\"}",
    ] {
        assert!(read_bench(text.as_bytes()).is_err(), "{text}");
    }
    Ok(())
}

#[test]
fn a_change_is_told_where_intervals_do_not_overlap() -> Tested {
    let old = report();
    let mut new = report();
    new.rows[1].relative = Some(6.0);
    new.rows[1].relative_95 = Some(interval(5.9, 6.1));
    // Within the spread: 3 (5 + 5) ns.
    new.rows[2].record_ns_per_draw = Some(89.0);
    new.rows[3].record_ns_per_draw = Some(91.0);
    let comparison = compare(&old, &new)?;
    let beyond: Vec<_> = comparison
        .changes
        .iter()
        .filter(|change| change.beyond_spread)
        .map(|change| (change.row, change.quantity))
        .collect();
    assert_eq!(beyond, [(1, "relative"), (3, "record_ns_per_draw")]);
    assert_eq!(comparison.largest_factor, Some(6.0 / 5.1));
    // Of the five rows that are no base, and have an interval, one is apart.
    let share = comparison.overlapping.unwrap_or_default();
    assert!((share - 5.0 / 6.0).abs() < 1e-9, "{share}");
    Ok(())
}

#[test]
fn against_itself_nothing_changed() -> Tested {
    let comparison = compare(&report(), &report())?;
    assert!(
        comparison
            .changes
            .iter()
            .all(|change| !change.beyond_spread && change.factor == 1.0)
    );
    assert_eq!(
        (comparison.overlapping, comparison.largest_factor),
        (Some(1.0), Some(1.0))
    );
    assert!(comparison.only_old.is_empty() && comparison.only_new.is_empty());
    Ok(())
}

#[test]
fn rows_that_one_of_them_lacks_are_told() -> Tested {
    let old = report();
    let mut new = report();
    new.rows.remove(1);
    let comparison = compare(&old, &new)?;
    assert_eq!(
        (&comparison.only_old[..], &comparison.only_new[..]),
        (&[1][..], &[][..])
    );
    Ok(())
}

#[test]
fn another_device_or_method_is_no_baseline() {
    let changed = |change: &dyn Fn(&mut BenchReport)| {
        let mut other = report();
        change(&mut other);
        compare(&other, &report())
            .map(|_| ())
            .map_err(|error| error.to_string())
    };
    assert!(changed(&|r| r.device.name = "another".into()).is_err_and(|e| e.contains("another")));
    assert!(changed(&|r| r.device.driver_version = "23".into()).is_err());
    assert!(
        changed(&|r| r.method.name = "vkoverhead".into()).is_err_and(|e| e.contains("vkoverhead"))
    );
    // The machine's kernel may change.
    assert!(changed(&|r| r.machine.system = "another".into()).is_ok());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn no_damage_makes_the_reader_panic(place in 0_usize..8000, byte: u8, cut in 0_usize..8000) {
        let mut bytes = bytes(&report()).unwrap_or_default();
        if let Some(damaged) = bytes.get_mut(place) {
            *damaged = byte;
        }
        bytes.truncate(bytes.len().saturating_sub(cut.saturating_sub(7000)));
        let _ = read_bench(&bytes);
    }
}
