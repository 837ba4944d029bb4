//! Which of several choices is beaten by none, in error and in time?

/// What a choice costs, and how wrong it is.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Point {
    /// Any unit, at least 0.
    pub time: f64,
    /// Any unit, at least 0.
    pub error: f64,
}

impl Point {
    /// Whether it is at least as good in both, and better in one.
    fn beats(&self, other: &Self) -> bool {
        self.time <= other.time && self.error <= other.error && self != other
    }

    /// By which factor `other` is at least as good in both; below 1 where this is better.
    fn behind(&self, other: &Self) -> f64 {
        // A hundredth of a percent: nobody sees it, and it keeps the quotient of nothing and nothing.
        const FLOOR: f64 = 1e-4;
        let error = (self.error + FLOOR) / (other.error + FLOOR);
        let time = (self.time + f64::MIN_POSITIVE) / (other.time + f64::MIN_POSITIVE);
        error.min(f64::MAX).max(time)
    }
}

/// Whether each is on the front: beaten by no other. What is no number is not.
pub fn front(points: &[Point]) -> Vec<bool> {
    let on = |point: &Point| {
        point.time.is_finite()
            && point.error.is_finite()
            && !points.iter().any(|other| other.beats(point))
    };
    points.iter().map(on).collect()
}

/// The places of the `count` that are nearest to the front, the nearest first; those on it first of all, by their time.
pub fn nearest(points: &[Point], count: usize) -> Vec<usize> {
    let on = front(points);
    let distance = |i: usize| {
        if on[i] {
            return 0.0;
        }
        let others = points.iter().zip(&on).filter(|(_, on)| **on);
        let nearest = others.map(|(other, _)| points[i].behind(other));
        nearest.fold(f64::INFINITY, f64::min)
    };
    let mut places: Vec<(f64, usize)> = (0..points.len()).map(|i| (distance(i), i)).collect();
    places.sort_by(|a, b| {
        let time = points[a.1].time.total_cmp(&points[b.1].time);
        a.0.total_cmp(&b.0).then(time)
    });
    places.into_iter().take(count).map(|(_, i)| i).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(of: &[(f64, f64)]) -> Vec<Point> {
        let of = of.iter();
        of.map(|(time, error)| Point {
            time: *time,
            error: *error,
        })
        .collect()
    }

    #[test]
    fn the_front_is_what_nothing_beats() {
        let made = points(&[(1.0, 9.0), (2.0, 5.0), (3.0, 5.0), (4.0, 1.0), (5.0, 2.0)]);
        assert_eq!(front(&made), [true, true, false, true, false]);
        // Equals do not beat each other, and what was not measured is nowhere.
        let made = points(&[
            (1.0, 1.0),
            (1.0, 1.0),
            (f64::NAN, 0.0),
            (0.5, f64::INFINITY),
        ]);
        assert_eq!(front(&made), [true, true, false, false]);
        assert!(front(&[]).is_empty());
    }

    #[test]
    fn the_nearest_follow_the_front() {
        let made = points(&[(1.0, 9.0), (2.0, 5.0), (2.1, 5.1), (4.0, 1.0), (8.0, 8.0)]);
        assert_eq!(nearest(&made, 4), [0, 1, 3, 2]);
        assert_eq!(nearest(&made, 9), [0, 1, 3, 2, 4]);
        assert!(nearest(&made, 0).is_empty());
    }
}
