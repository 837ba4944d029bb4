//! How far is a model from a truth: as published, and with its parameters free?

use glam::DVec3;

use crate::reference::truth::{Grid, Truth};

/// A model, f in 1/sr of light, eye (the normal is +Z), roughness and albedo.
pub type Model = fn(DVec3, DVec3, f64, f64) -> f64;

/// How far two functions on a grid are apart.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Distance {
    /// Cosine-weighted root mean square, of the truth's own.
    pub rms: f64,
    /// The largest, of the truth there, where that is at least a thousandth of its peak.
    pub largest: f64,
}

/// Beside a lobe a truth is next to nothing, and any model many times as much: the largest error is looked for where it is at least this
/// share of its largest value.
const LEAST_SHARE: f64 = 1.0e-3;

/// The distance of a model from one channel of a truth.
pub fn distance(
    grid: &Grid,
    truth: &Truth,
    channel: usize,
    model: impl Fn(DVec3, DVec3) -> f64,
) -> Distance {
    let peak = truth.f.iter().map(|f| f[channel]).fold(0.0, f64::max);
    let (mut off, mut whole, mut largest) = (0.0, 0.0, 0.0_f64);
    for (((l, e), weight), f) in grid.cells().zip(grid.weights()).zip(&truth.f) {
        let (got, want) = (model(l, e), f[channel]);
        off += weight * (got - want).powi(2);
        whole += weight * want * want;
        if want >= LEAST_SHARE * peak {
            largest = largest.max((got / want - 1.0).abs());
        }
    }
    Distance {
        rms: (off / whole).sqrt(),
        largest,
    }
}

/// The truth's own statistical error, in the same measure.
pub fn noise(grid: &Grid, truth: &Truth, channel: usize) -> f64 {
    let (mut off, mut whole) = (0.0, 0.0);
    for ((weight, f), error) in grid.weights().into_iter().zip(&truth.f).zip(&truth.error) {
        off += weight * error[channel].powi(2);
        whole += weight * f[channel].powi(2);
    }
    (off / whole).sqrt()
}

/// The least distance with roughness and albedo free, from where they are given; `most`: the largest albedo that the model has.
pub fn refitted(
    grid: &Grid,
    truth: &Truth,
    channel: usize,
    model: Model,
    (roughness, albedo): (f64, f64),
    most: f64,
) -> Distance {
    let at = |[r, rho]: [f64; 2]| distance(grid, truth, channel, |l, e| model(l, e, r, rho));
    let held = |[r, rho]: [f64; 2]| [r.clamp(0.0, 2.0), rho.clamp(0.0, most)];
    // A compass: steps along both parameters, and along both at once, halved where none is better.
    let mut place = held([roughness, albedo]);
    let mut best = at(place);
    let mut step = 0.2;
    while step > SMALLEST_STEP {
        let tried = (-1..=1).flat_map(|a| (-1..=1).map(move |b| [f64::from(a), f64::from(b)]));
        let better = tried
            .map(|[a, b]| held([place[0] + a * step, place[1] + b * step]))
            .map(|place| (place, at(place)))
            .min_by(|a, b| a.1.rms.total_cmp(&b.1.rms));
        match better {
            Some((next, distance)) if distance.rms < best.rms => (place, best) = (next, distance),
            _ => step *= 0.5,
        }
    }
    best
}

/// A parameter's last digit that counts: the RMS changes by its square.
const SMALLEST_STEP: f64 = 1.0e-4;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::fujii;
    use crate::reference::truth::MATTE;

    fn model(l: DVec3, e: DVec3, roughness: f64, albedo: f64) -> f64 {
        albedo * fujii::lobe(DVec3::Z, l, e, roughness) / (std::f64::consts::PI * l.z)
    }

    /// A truth that is the model itself.
    fn truth(roughness: f64, albedo: f64) -> Truth {
        let f: Vec<_> = MATTE
            .cells()
            .map(|(l, e)| [model(l, e, roughness, albedo); 3])
            .collect();
        Truth {
            error: vec![[0.0; 3]; f.len()],
            f,
        }
    }

    #[test]
    fn a_model_is_no_distance_from_itself_and_a_scaled_one_its_scale() {
        let truth = truth(0.6, 0.5);
        let own = distance(&MATTE, &truth, 1, |l, e| model(l, e, 0.6, 0.5));
        assert_eq!((own.rms, own.largest), (0.0, 0.0));
        let scaled = distance(&MATTE, &truth, 1, |l, e| model(l, e, 0.6, 0.55));
        assert!((scaled.rms - 0.1).abs() < 1e-12 && (scaled.largest - 0.1).abs() < 1e-12);
        assert_eq!(noise(&MATTE, &truth, 0), 0.0);
    }

    #[test]
    fn free_parameters_are_found() {
        let found = refitted(&MATTE, &truth(0.83, 0.37), 0, model, (0.3, 0.9), 1.0);
        assert!(found.rms < 1e-3, "{found:?}");
    }
}
