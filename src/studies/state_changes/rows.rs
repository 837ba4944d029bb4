//! What do a cell's frames say?

use super::Timing;
use super::plan::{Cell, Group};
use crate::gpu::PassCounts;
use crate::math::statistics::{Interval, mad, median, median_interval, paired_ratio};
use crate::render::state_changes::{Made, Sample};
use crate::report::{BenchRow, Interval95};

/// What was measured of a cell.
pub struct Measured<'a> {
    /// Visit by visit.
    pub visits: Vec<Beside<'a>>,
    /// What making it took.
    pub made: Made,
    /// What a frame records.
    pub counts: PassCounts,
    /// Its picture's, in hexadecimal.
    pub hash: Option<String>,
}

/// A visit's frames of a cell and of its base, round by round.
#[derive(Clone, Copy)]
pub struct Beside<'a> {
    /// The cell's.
    pub own: &'a [Option<Sample>],
    /// Its base's.
    pub base: &'a [Option<Sample>],
}

/// An interval wider than this share of its estimate does not tell a ratio from its neighbours.
const NOISY: f64 = 0.2;

/// The row of a cell; without figures where nothing was measured.
pub fn row(
    group: &Group,
    cell: &Cell,
    (width, height): (u32, u32),
    measured: Option<Measured>,
    mut notes: Vec<String>,
    timing: Timing,
) -> BenchRow {
    let wall = group.wall(group.materials, 0);
    let mut row = BenchRow {
        mode: cell.mode.name.to_owned(),
        order: cell.order.name().to_owned(),
        scene: group.scene.name().to_owned(),
        materials: group.materials,
        draws: group.draws,
        pixels_per_draw: wall.pixels_per_object(),
        width,
        height,
        record_ns_per_draw: None,
        record_mad: None,
        submit_to_idle_ms: None,
        submit_to_idle_mad: None,
        gpu_ms: None,
        gpu_mad: None,
        samples: 0,
        devices: 0,
        draw_calls: 0,
        pipeline_binds: 0,
        descriptor_set_binds: 0,
        push_constants: 0,
        pipelines_created: 0,
        creation_cold_ms: None,
        creation_warm_ms: None,
        memory_bytes: 0,
        image_hash: None,
        base: cell.mode.base.to_owned(),
        relative: None,
        relative_95: None,
        record_relative: None,
        record_relative_95: None,
        note: String::new(),
    };
    if let Some(measured) = measured {
        fill(&mut row, &measured, timing);
        notes.extend(warnings(&row));
    }
    row.note = notes.join("; ");
    row
}

fn fill(row: &mut BenchRow, measured: &Measured, timing: Timing) {
    let draws = f64::from(row.draws);
    let record = values(measured, |sample| Some(sample.record_ns / draws));
    row.record_ns_per_draw = median(&record);
    row.record_mad = mad(&record);
    row.samples = record.len() as u32;
    row.devices = measured.visits.len() as u32;
    let record = ratio(measured, |sample| Some(sample.record_ns));
    row.record_relative = record.map(|ratio| ratio.estimate);
    row.record_relative_95 = record.map(Interval95::from);
    let mut relative = record;
    if timing == Timing::Submit {
        let submit = values(measured, |sample| Some(sample.submit_to_idle_ms));
        row.submit_to_idle_ms = median(&submit);
        row.submit_to_idle_mad = mad(&submit);
        let gpu = values(measured, |sample| sample.gpu_ms);
        row.gpu_ms = median(&gpu);
        row.gpu_mad = mad(&gpu);
        relative = ratio(measured, |sample| Some(sample.submit_to_idle_ms));
    }
    row.relative = relative.map(|ratio| ratio.estimate);
    row.relative_95 = relative.map(Interval95::from);
    row.draw_calls = measured.counts.draws;
    row.pipeline_binds = measured.counts.pipeline_binds;
    row.descriptor_set_binds = measured.counts.descriptor_set_binds;
    row.push_constants = measured.counts.push_constants;
    row.pipelines_created = measured.made.pipelines;
    row.memory_bytes = measured.made.memory_bytes;
    row.image_hash.clone_from(&measured.hash);
}

fn values(measured: &Measured, of: impl Fn(&Sample) -> Option<f64>) -> Vec<f64> {
    let own = measured.visits.iter().flat_map(|visit| visit.own);
    own.flatten().filter_map(of).collect()
}

/// The median over visits of each one's median over the rounds in which both were drawn: what the frames of a visit
/// share does not narrow the interval. Of one visit, the median over its rounds.
fn ratio(measured: &Measured, of: impl Fn(&Sample) -> Option<f64>) -> Option<Interval> {
    let of_visit = |visit: &Beside| {
        let rounds = visit.own.iter().zip(visit.base);
        let pairs = rounds.filter_map(|(own, base)| {
            let (own, base) = (own.as_ref()?, base.as_ref()?);
            Some((of(own)?, of(base)?))
        });
        paired_ratio(&pairs.collect::<Vec<_>>())
    };
    if let [one] = &measured.visits[..] {
        return of_visit(one);
    }
    let visits = measured.visits.iter().filter_map(of_visit);
    median_interval(&visits.map(|ratio| ratio.estimate).collect::<Vec<_>>())
}

/// Where the frames do not say enough.
fn warnings(row: &BenchRow) -> Option<String> {
    let estimate = row.relative?;
    match row.relative_95 {
        Some(Interval95 {
            low: Some(low),
            high: Some(high),
        }) if high - low > NOISY * estimate => Some(format!("noisy: {low:.2} to {high:.2}")),
        Some(Interval95 {
            low: Some(_),
            high: Some(_),
        }) => None,
        _ => Some(format!("no interval: {} frames", row.samples)),
    }
}

#[cfg(test)]
mod tests {
    use super::super::plan::SceneKind;
    use super::*;
    use crate::render::state_changes::MODES;
    use crate::scene::Order;

    fn sample(ms: f64) -> Option<Sample> {
        Some(Sample {
            record_ns: ms * 1e3,
            submit_to_idle_ms: ms,
            gpu_ms: Some(ms * 0.5),
            counts: counts(),
        })
    }

    fn counts() -> PassCounts {
        PassCounts {
            name: "shading".into(),
            draws: 10,
            pipeline_binds: 3,
            descriptor_set_binds: 1,
            push_constants: 0,
            cull_changes: 0,
        }
    }

    /// The row of frames of `own` beside frames of `base`, a visit a round.
    fn of(own: &[Option<Sample>], base: &[Option<Sample>], timing: Timing) -> BenchRow {
        of_visits(own, base, 1, timing)
    }

    /// The same with so many rounds in a visit.
    fn of_visits(
        own: &[Option<Sample>],
        base: &[Option<Sample>],
        rounds: usize,
        timing: Timing,
    ) -> BenchRow {
        let visits = own.chunks(rounds).zip(base.chunks(rounds));
        let visits = visits.map(|(own, base)| Beside { own, base }).collect();
        let cell = Cell {
            mode: &MODES[8],
            order: Order::Shuffled,
        };
        let group = Group {
            scene: SceneKind::Tiny,
            materials: 4,
            draws: 10,
            cells: vec![cell],
        };
        let measured = Measured {
            visits,
            made: Made::default(),
            counts: counts(),
            hash: None,
        };
        row(&group, &cell, (5, 5), Some(measured), Vec::new(), timing)
    }

    #[test]
    fn a_ratio_is_taken_round_by_round_and_a_drifting_clock_cancels() {
        // The clock slows down by 20 times; the ratio stays 2.
        let base: Vec<_> = (1..=20).map(|ms| sample(f64::from(ms))).collect();
        let own: Vec<_> = (1..=20).map(|ms| sample(2.0 * f64::from(ms))).collect();
        let row = of(&own, &base, Timing::Submit);
        assert_eq!(row.relative, Some(2.0));
        let exact = Interval95 {
            low: Some(2.0),
            high: Some(2.0),
        };
        assert_eq!(row.relative_95, Some(exact));
        assert_eq!(row.note, "");
        assert_eq!((row.samples, row.submit_to_idle_ms), (20, Some(21.0)));
        assert_eq!(
            (row.gpu_ms, row.submit_to_idle_mad),
            (Some(10.5), Some(10.0))
        );
        assert_eq!(row.record_ns_per_draw, Some(2100.0));
    }

    #[test]
    fn too_few_and_too_scattered_frames_are_told() {
        let steady: Vec<_> = (0..12).map(|_| sample(1.0)).collect();
        let few = of(&steady[..5], &steady[..5], Timing::Submit);
        assert_eq!(few.note, "no interval: 5 frames");
        let scattered: Vec<_> = (0..12).map(|n| sample(1.0 + f64::from(n % 2))).collect();
        let noisy = of(&scattered, &steady, Timing::Submit);
        assert!(noisy.note.starts_with("noisy: "), "{}", noisy.note);
    }

    #[test]
    fn what_the_frames_of_a_visit_share_does_not_narrow_the_interval() {
        let base: Vec<_> = (0..12).map(|_| sample(1.0)).collect();
        // Within a visit all frames agree; of six visits one is slower by a fifth.
        let own: Vec<_> = (0..12)
            .map(|n| sample(if n < 2 { 2.4 } else { 2.0 }))
            .collect();
        let row = of_visits(&own, &base, 2, Timing::Submit);
        assert_eq!((row.samples, row.relative), (12, Some(2.0)));
        let interval = row.relative_95.expect("six visits");
        assert_eq!((interval.low, interval.high), (Some(2.0), Some(2.4)));
        let five = of_visits(&own[2..], &base[2..], 2, Timing::Submit);
        assert_eq!(five.relative_95.and_then(|interval| interval.low), None);
    }

    #[test]
    fn rounds_in_which_one_of_them_was_not_drawn_do_not_count() {
        let base: Vec<_> = (0..12).map(|_| sample(1.0)).collect();
        let own: Vec<_> = (0..12).map(|n| sample(3.0).filter(|_| n < 7)).collect();
        let row = of(&own, &base, Timing::Submit);
        assert_eq!((row.samples, row.relative), (7, Some(3.0)));
    }

    #[test]
    fn what_is_never_submitted_is_compared_by_its_recording() {
        let base: Vec<_> = (0..12).map(|_| sample(1.0)).collect();
        let own: Vec<_> = (0..12).map(|_| sample(1.5)).collect();
        let row = of(&own, &base, Timing::RecordAndReset);
        assert_eq!((row.submit_to_idle_ms, row.gpu_ms), (None, None));
        assert_eq!(row.relative, Some(1.5));
    }
}
