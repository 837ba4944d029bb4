//! From how many pixels a material on does a pipeline of its own pay?
//!
//! A switch costs the same whatever is drawn after it, and the specialised code saves something at every pixel. Squares
//! of growing size, each of a material of its own, show where the two meet.

use crate::render::state_changes::{DYNAMIC, ONE_PIPELINE, PIPELINE_PER_MATERIAL};
use crate::report::{BenchRow, BreakEven, Interval95};

/// The time of switching over that of a single pipeline, for squares of one size.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Point {
    pixels: f64,
    ratio: f64,
    low: f64,
    high: f64,
}

/// One for each single pipeline and number of materials that `rows` has patches of.
pub fn break_evens(rows: &[BenchRow]) -> Vec<BreakEven> {
    let patches = rows.iter().filter(|row| row.scene == "patches");
    let mut materials: Vec<_> = patches.map(|row| row.materials).collect();
    materials.sort_unstable();
    materials.dedup();
    let singles = [ONE_PIPELINE, DYNAMIC].into_iter();
    singles
        .flat_map(|single| materials.iter().map(move |materials| (single, *materials)))
        .filter_map(|(single, materials)| {
            let points = points(rows, single, materials);
            (points.len() >= 2).then(|| break_even(single, materials, &points))
        })
        .collect()
}

/// By size, small to large.
fn points(rows: &[BenchRow], single: &str, materials: u32) -> Vec<Point> {
    let of = |mode: &str| {
        let mode = mode.to_owned();
        rows.iter().filter(move |row| {
            row.scene == "patches" && row.mode == mode && row.materials == materials
        })
    };
    let mut points: Vec<_> = of(PIPELINE_PER_MATERIAL)
        .filter_map(|switching| {
            let (ratio, low, high) = relative(switching)?;
            let single = of(single).find(|row| row.pixels_per_draw == switching.pixels_per_draw)?;
            // Both are relative to one base; the widest interval that theirs allow.
            let (single, single_low, single_high) = relative(single)?;
            Some(Point {
                pixels: switching.pixels_per_draw,
                ratio: ratio / single,
                low: low / single_high,
                high: high / single_low,
            })
        })
        .collect();
    points.sort_by(|a, b| a.pixels.total_cmp(&b.pixels));
    points
}

/// A ratio with its bounds; without bounds it says nothing.
fn relative(row: &BenchRow) -> Option<(f64, f64, f64)> {
    let Interval95 { low, high } = row.relative_95?;
    Some((row.relative?, low?, high?))
}

fn break_even(single: &str, materials: u32, points: &[Point]) -> BreakEven {
    let (first, last) = (points[0].pixels, points[points.len() - 1].pixels);
    // The last size at which switching is not the faster.
    let slower = points.iter().rposition(|point| point.ratio >= 1.0);
    let pixels = match slower {
        None => Some(first),
        Some(place) => points
            .get(place + 1)
            .map(|next| meeting(points[place], *next)),
    };
    // Up to here it surely loses, from there on it surely wins.
    let loses = points.iter().take_while(|point| point.low > 1.0).last();
    let wins = points
        .iter()
        .rev()
        .take_while(|point| point.high < 1.0)
        .last();
    let note = match (slower, pixels) {
        (None, _) => format!("switching is the faster at every size measured, {first} pixels on"),
        (_, None) => format!("switching does not pay at any size measured, up to {last} pixels"),
        _ => String::new(),
    };
    BreakEven {
        single: single.to_owned(),
        materials,
        pixels,
        pixels_95: Some(Interval95 {
            low: loses.map(|point| point.pixels),
            high: wins.map(|point| point.pixels),
        }),
        note,
    }
}

/// Where the ratio passes 1 between two sizes, along a line over the logarithm of the pixels.
fn meeting(slower: Point, faster: Point) -> f64 {
    let share = (slower.ratio - 1.0) / (slower.ratio - faster.ratio);
    let [from, to] = [slower, faster].map(|point| point.pixels.ln());
    (from + share * (to - from)).exp()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(pixels: f64, ratio: f64) -> Point {
        Point {
            pixels,
            ratio,
            low: ratio - 0.05,
            high: ratio + 0.05,
        }
    }

    #[test]
    fn it_lies_where_the_ratio_passes_one() {
        let points =
            [(1.0, 3.0), (16.0, 1.4), (256.0, 0.6), (4096.0, 0.5)].map(|(p, r)| point(p, r));
        let found = break_even(ONE_PIPELINE, 64, &points);
        // Half way between 16 and 256 on a logarithmic scale.
        assert!(
            found
                .pixels
                .is_some_and(|pixels| (pixels - 64.0).abs() < 1e-9)
        );
        let bounds = Interval95 {
            low: Some(16.0),
            high: Some(256.0),
        };
        assert_eq!((found.pixels_95, &*found.note), (Some(bounds), ""));
    }

    #[test]
    fn never_and_always_are_said() {
        let never = break_even(ONE_PIPELINE, 64, &[point(1.0, 3.0), point(64.0, 1.02)]);
        assert_eq!(never.pixels, None);
        assert!(never.note.contains("does not pay"), "{}", never.note);
        let always = break_even(ONE_PIPELINE, 64, &[point(1.0, 0.8), point(64.0, 0.5)]);
        assert_eq!(always.pixels, Some(1.0));
        assert!(always.note.contains("at every size"), "{}", always.note);
    }
}
