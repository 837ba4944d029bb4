//! How are a cell and a figure of `umber bench` written, wherever they are read?

use super::bench::{BenchReport, BenchRow};
use super::interval::Interval95;

/// `10,000`.
pub fn thousands(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// `1 draw`, `10,000 draws`.
pub fn count(number: u64, what: &str) -> String {
    let plural = if number == 1 { "" } else { "s" };
    format!("{} {what}{plural}", thousands(number))
}

/// Digits behind the point with which a figure of about this size is told: what is near 1 differs in the second.
pub fn digits(figure: f64) -> usize {
    match figure.abs() {
        x if x >= 100.0 => 0,
        x if x >= 2.0 => 1,
        x if x >= 0.1 || x == 0.0 => 2,
        x => (-x.log10()).ceil().min(12.0) as usize + 1,
    }
}

/// A figure with as many digits as suit it.
pub fn figure(x: f64) -> String {
    match x.is_finite() {
        true if x.abs() >= 1000.0 && x.abs() < 1e15 => {
            let sign = if x < 0.0 { "-" } else { "" };
            format!("{sign}{}", thousands(x.abs().round() as u64))
        }
        true => format!("{x:.*}", digits(x)),
        false => "-".to_owned(),
    }
}

/// The bounds of an interval that has both.
pub fn bounds(interval: Option<Interval95>) -> Option<(f64, f64)> {
    let interval = interval?;
    Some((interval.low?, interval.high?))
}

/// `5.1 (4.9 to 5.3)`.
pub fn ratio(row: &BenchRow) -> Option<String> {
    let relative = row.relative?;
    let digits = digits(relative);
    Some(match bounds(row.relative_95) {
        Some((low, high)) => format!("{relative:.digits$} ({low:.digits$} to {high:.digits$})"),
        None => format!("{relative:.digits$} (too few frames for an interval)"),
    })
}

/// `tiny, 64 materials, 10,000 draws, shuffled`.
pub fn cell(row: &BenchRow) -> String {
    format!("{}, {}", group(row), plain(&row.order))
}

/// `tiny, 64 materials, 10,000 draws`.
pub fn group(row: &BenchRow) -> String {
    let mut text = plain(&row.scene);
    if row.scene == "patches" {
        text.push_str(&format!(", {} pixels a draw", figure(row.pixels_per_draw)));
    }
    let materials = count(row.materials.into(), "material");
    let draws = count(row.draws.into(), "draw");
    format!("{text}, {materials}, {draws}")
}

/// What tells a row's cell from another's, less its mode and order.
pub type Group<'r> = (&'r str, u32, u32, u32, u32, u64);

/// The group of a row. Only patches differ in nothing but their pixels; elsewhere those are a mean that
/// follows from the rest.
pub fn group_key(row: &BenchRow) -> Group<'_> {
    let pixels = match row.scene.as_str() {
        "patches" => row.pixels_per_draw.round() as u64,
        _ => 0,
    };
    let size = (row.width, row.height);
    (&row.scene, row.materials, row.draws, size.0, size.1, pixels)
}

/// Groups in the order in which they first appear, each with its rows: the base first, and else in their order.
pub fn groups(report: &BenchReport) -> Vec<Vec<usize>> {
    let mut place = std::collections::HashMap::new();
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for (i, row) in report.rows.iter().enumerate() {
        let at = *place.entry(group_key(row)).or_insert(groups.len());
        match groups.get_mut(at) {
            Some(group) => group.push(i),
            None => groups.push(vec![i]),
        }
    }
    for group in &mut groups {
        group.sort_by_key(|&i| report.rows[i].mode != report.rows[i].base);
    }
    groups
}

/// Whether `relative` speaks of recording and not of frames.
pub fn records_only(report: &BenchReport) -> bool {
    report.method.name == "vkoverhead"
}

/// The text with nothing in it that could steer a terminal or turn its line around: names come from drivers.
pub fn plain(text: &str) -> String {
    let turns = |c| matches!(c, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    // The two at the end of the plane are no characters of XML either.
    let bad = |c: char| c.is_control() || turns(c) || matches!(c, '\u{fffe}' | '\u{ffff}');
    text.chars()
        .map(|c| if bad(c) { '\u{fffd}' } else { c })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_grouped_by_thousands() {
        for (number, want) in [
            (0, "0"),
            (999, "999"),
            (1000, "1,000"),
            (1_000_000, "1,000,000"),
        ] {
            assert_eq!(thousands(number), want);
        }
        assert_eq!(count(1, "draw"), "1 draw");
        assert_eq!(count(0, "draw"), "0 draws");
    }

    #[test]
    fn figures_have_the_digits_that_differ() {
        for (x, want) in [
            (5.14, "5.1"),
            (1.064, "1.06"),
            (0.49, "0.49"),
            (0.0, "0.00"),
            (0.0123, "0.012"),
            (123.4, "123"),
            (12345.6, "12,346"),
            (-2345.6, "-2,346"),
            (f64::NAN, "-"),
            (f64::INFINITY, "-"),
        ] {
            assert_eq!(figure(x), want);
        }
    }

    #[test]
    fn no_text_steers_a_terminal() {
        assert_eq!(
            plain("a\u{1b}[2J\n\u{202e}b"),
            "a\u{fffd}[2J\u{fffd}\u{fffd}b"
        );
        assert_eq!(
            plain("llvmpipe (LLVM 15.0.6, 256 bits) é"),
            "llvmpipe (LLVM 15.0.6, 256 bits) é"
        );
    }
}
