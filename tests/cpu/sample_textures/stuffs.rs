//! What do wood, carpet, dirt and plaster look like from near: colour, roughness, height?
//!
//! Colours are factors on an albedo, linear; heights are in units of the picture's side.

use super::torus::{Point, around, cellular, fractal, lerp, mix, noise, step, unit};

/// Mixes two colours.
fn blend(a: [f64; 3], b: [f64; 3], t: f64) -> [f64; 3] {
    [0, 1, 2].map(|k| lerp(a[k], b[k], t))
}

/// Growth rings across a picture of wood, whose grain runs along u.
const RINGS: u32 = 15;

/// Where a point lies in its year: 0 where spring wood begins, 1 where the year ends.
fn season(p: Point) -> f64 {
    let sway = 0.085 * noise(p, [1, 2], 11)
        + 0.045 * noise(p, [2, 4], 12)
        + 0.010 * noise(p, [5, 12], 13)
        + 0.002 * noise(p, [14, 60], 15);
    let ring = (p[1] + sway) * f64::from(RINGS);
    // Years are not alike; the row of noise repeats with the rings.
    let age = [0.31, ring / f64::from(RINGS)];
    let uneven = ring + 0.9 * noise(age, [1, RINGS], 14) + 1.3 * noise(age, [1, 4], 16);
    uneven - uneven.floor()
}

/// How much of summer's dense, dark wood is in a point: it grows over the year and ends at once.
fn late(year: f64) -> f64 {
    step(0.15, 1.0, year) * (1.0 - step(0.94, 1.0, year))
}

/// Open vessels, 0..1: short dark lines, crowded into the spring wood.
fn pores(p: Point, year: f64) -> f64 {
    let spring = 1.0 - step(0.05, 0.45, year) * (1.0 - step(0.97, 1.0, year));
    let mut depth = 0.0_f64;
    for (cells, seed, share) in [([9, 150], 21, 0.75), ([14, 190], 22, 0.55)] {
        around(p, cells, 0.9, seed, |[dx, dy], hash| {
            let present = unit(hash, 5) < share * lerp(0.14, 1.0, spring);
            let (length, width) = (0.20 + 0.45 * unit(hash, 6), 0.20 + 0.16 * unit(hash, 7));
            let inside = 1.0 - (dx / length).powi(2) - (dy / width).powi(2);
            if present {
                depth = depth.max(inside.clamp(0.0, 1.0) * (0.5 + 0.5 * unit(hash, 8)));
            }
        });
    }
    depth
}

/// Fibres along the grain, about -1..1.
fn fibres(p: Point) -> f64 {
    0.55 * fractal(p, [3, 60], 3, 0.7, 31) + 0.45 * noise(p, [16, 240], 33)
}

/// Oiled oak.
pub fn wood_color(p: Point) -> [f64; 3] {
    let year = season(p);
    let (late, pore) = (late(year), pores(p, year));
    let plank = 0.10 * fractal(p, [2, 5], 3, 0.6, 35);
    let light = 0.88 + plank + 0.20 * fibres(p);
    let tint = blend([1.0, 1.0, 1.0], [0.78, 0.68, 0.58], late);
    let tint = blend(tint, [0.42, 0.34, 0.28], 0.75 * pore);
    tint.map(|c| c * light)
}

/// Oil stands on dense wood and sinks into pores.
pub fn wood_roughness(p: Point) -> f64 {
    let year = season(p);
    0.86 - 0.16 * late(year) + 0.05 * fibres(p) + 0.22 * pores(p, year)
}

pub fn wood_height(p: Point) -> f64 {
    let year = season(p);
    0.0006 * late(year) + 0.00028 * fibres(p) - 0.0018 * pores(p, year)
}

/// Tufts of a carpet's pile along each side.
const TUFTS: u32 = 22;

/// One tuft as seen from above: its height 0..1, the strand of its yarn -1..1, and its hash.
fn tuft(p: Point) -> (f64, f64, u32) {
    // Each bends its neighbours' outlines a little.
    let bend = [41, 42].map(|seed| 0.008 * noise(p, [3 * TUFTS, 3 * TUFTS], seed));
    let q = [p[0] + bend[0], p[1] + bend[1]];
    let (mut height, mut strand, mut top) = (0.0, 0.0, 0);
    around(q, [TUFTS, TUFTS], 0.5, 43, |[dx, dy], hash| {
        let size = 0.66 + 0.16 * unit(hash, 5);
        let rise = (1.0 - (dx * dx + dy * dy) / (size * size)).max(0.0).sqrt();
        let rise = rise * (0.75 + 0.25 * unit(hash, 6));
        if rise > height {
            // The yarn's fibres lie side by side and fan out at its cut end.
            let turn = std::f64::consts::TAU * unit(hash, 7);
            let (sin, cos) = turn.sin_cos();
            let along = cos * dx + sin * dy;
            let across = cos * dy - sin * dx;
            strand = (across * (24.0 - 14.0 * along) + 6.0 * unit(hash, 8)).sin();
            (height, top) = (rise, hash);
        }
    });
    (height, strand, top)
}

/// Wool, dyed in hanks that differ a little.
pub fn carpet_color(p: Point) -> [f64; 3] {
    let (height, strand, hash) = tuft(p);
    let fuzz = noise(p, [170, 170], 45);
    let hank = 0.16 * (unit(hash, 9) - 0.5) + 0.07 * fractal(p, [3, 4], 2, 0.5, 46);
    // Little light comes out from between tufts and fibres.
    let depth = lerp(0.30, 1.0, step(0.0, 0.9, height));
    let light = depth * (0.86 + hank + 0.13 * strand + 0.12 * fuzz);
    let warm = 0.06 * (unit(hash, 10) - 0.5);
    [light * (1.0 + warm), light, light * (1.0 - warm)]
}

pub fn carpet_height(p: Point) -> f64 {
    let (height, strand, _) = tuft(p);
    let fuzz = noise(p, [120, 120], 47);
    (0.36 * height + 0.05 * height * strand + 0.05 * fuzz) / f64::from(TUFTS)
}

/// A stone that lies in the soil: how far it stands out, 0..1, and its hash.
fn stone(p: Point) -> (f64, u32) {
    let dent = [51, 52].map(|seed| 0.012 * fractal(p, [14, 14], 2, 0.5, seed));
    let q = [p[0] + dent[0], p[1] + dent[1]];
    let mut best = (0.0, 0);
    for (cells, seed, share) in [
        ([6, 6], 53, 0.20),
        ([14, 14], 54, 0.16),
        ([36, 36], 55, 0.14),
    ] {
        around(q, cells, 0.8, seed, |[dx, dy], hash| {
            let turn = std::f64::consts::TAU * unit(hash, 6);
            let (sin, cos) = turn.sin_cos();
            let size = 0.16 + 0.22 * unit(hash, 7);
            let (x, y) = (
                cos * dx + sin * dy,
                (cos * dy - sin * dx) * (1.0 + 0.6 * unit(hash, 8)),
            );
            let rise = (1.0 - (x * x + y * y) / (size * size)).max(0.0).sqrt();
            if unit(hash, 5) < share && rise > best.0 {
                best = (rise, hash);
            }
        });
    }
    best
}

/// Crumbs of several sizes, 0..1: lumps with dark gaps between.
fn crumbs(p: Point) -> f64 {
    let bend = [61, 62].map(|seed| 0.016 * fractal(p, [12, 12], 4, 0.7, seed));
    let q = [p[0] + bend[0], p[1] + bend[1]];
    let (mut sum, mut weight, mut all) = (0.0, 1.0, 0.0);
    for (cells, seed) in [(10, 63), (22, 64), (46, 65), (90, 66)] {
        let (first, second, hash) = cellular(q, [cells, cells], 1.0, seed);
        let size = 0.35 + 0.65 * unit(hash, 5);
        sum += weight * size * step(0.0, 0.55, second - first);
        all += weight;
        weight *= 0.72;
    }
    sum / all
}

/// Soil with a few small stones.
pub fn dirt_color(p: Point) -> [f64; 3] {
    let (rise, hash) = stone(p);
    let damp = fractal(p, [3, 3], 4, 0.6, 67);
    let grain = noise(p, [140, 140], 68);
    let light = lerp(0.46, 1.12, step(0.05, 0.55, crumbs(p))) * (0.94 + 0.16 * damp + 0.16 * grain);
    let soil = blend(
        [0.86, 0.74, 0.64],
        [1.0, 0.96, 0.90],
        step(-0.5, 0.5, damp + 0.3 * grain),
    );
    // Dust of the soil lies on the stones.
    let grey = 0.50 + 0.40 * unit(hash, 9);
    let pale = blend([0.92, 1.0, 1.06], [1.0, 0.90, 0.76], unit(hash, 10));
    let mottle = 1.0 + 0.25 * fractal(p, [60, 60], 2, 0.7, 69);
    let stone = pale.map(|c| c * grey * mottle * lerp(0.35, 1.0, rise.min(0.6) / 0.6));
    blend(soil.map(|c| c * light), stone, step(0.0, 0.25, rise))
}

/// Stones are smoother than loose grains.
pub fn dirt_roughness(p: Point) -> f64 {
    let (rise, hash) = stone(p);
    let stone = 0.55 + 0.2 * unit(hash, 11);
    lerp(
        0.97 + 0.03 * noise(p, [100, 100], 70),
        stone,
        step(0.1, 0.4, rise),
    )
}

pub fn dirt_height(p: Point) -> f64 {
    let (rise, _) = stone(p);
    let grain = 0.0016 * (1.0 - rise) * fractal(p, [50, 50], 3, 0.8, 72);
    let soil = 0.022 * lerp(crumbs(p), 0.5, step(0.0, 0.4, rise))
        + 0.010 * fractal(p, [5, 5], 3, 0.5, 71)
        + grain;
    soil + 0.013 * rise
}

/// One stroke of the trowel at a point: how much of it is left there, its height and its scratches.
fn stroke([dx, dy]: Point, hash: u32) -> [f64; 3] {
    // Strokes go from lower left to upper right, as a right arm swings.
    let turn = 0.55 + 1.3 * (unit(hash, 5) - 0.5);
    let (sin, cos) = turn.sin_cos();
    let along = cos * dx + sin * dy;
    let across = cos * dy - sin * dx + (0.15 + 0.2 * unit(hash, 11)) * along * along;
    let (end, side) = (
        along.abs() / 1.0,
        across.abs() / (0.34 + 0.16 * unit(hash, 6)),
    );
    let cover = (1.0 - step(0.55, 1.0, end)) * (1.0 - step(0.94, 1.0, side));
    // Flat, a little tilted, with a ridge where an end of the blade passes.
    let ridge = step(0.82, 0.93, side) * (0.15 + 0.85 * unit(hash, 9));
    let tilt = across * (unit(hash, 8) - 0.5);
    let fine = noise([along * 0.01, across * 0.5], [64, 150], mix(hash));
    let lines = noise([along * 0.02, across * 0.5], [64, 64], hash) + 0.6 * fine;
    let height = 0.32 * tilt + 0.05 * ridge;
    [cover, height, lines * unit(hash, 10)]
}

/// Trowel strokes over each other: height and scratches.
fn strokes(p: Point) -> (f64, f64) {
    let mut found = Vec::with_capacity(18);
    for (cells, seed) in [([3, 4], 81), ([4, 3], 82)] {
        around(p, cells, 0.9, seed, |way, hash| found.push((hash, way)));
    }
    // The order in which they were made is that of their hashes.
    found.sort_by_key(|(hash, _)| *hash);
    let (mut height, mut scratch) = (0.0, 0.0);
    for (hash, way) in found {
        let [cover, own, lines] = stroke(way, hash);
        height = lerp(height, own, cover);
        scratch = lerp(scratch, lines, cover);
    }
    (height, scratch)
}

/// Grains of sand that the blade dragged open: small pits, 0..1.
fn pits(p: Point) -> f64 {
    let mut depth = 0.0_f64;
    around(p, [44, 44], 0.9, 85, |[dx, dy], hash| {
        let size = 0.10 + 0.22 * unit(hash, 6).powi(3);
        if unit(hash, 5) < 0.06 {
            depth = depth.max((1.0 - (dx * dx + dy * dy) / (size * size)).max(0.0));
        }
    });
    depth
}

/// Lime plaster.
pub fn plaster_color(p: Point) -> [f64; 3] {
    let (height, scratch) = strokes(p);
    let cloud = fractal(p, [3, 3], 4, 0.55, 86);
    let light = 0.95 + 0.04 * cloud + 0.25 * height + 0.02 * scratch - 0.14 * pits(p);
    let warm = 0.02 * fractal(p, [2, 2], 3, 0.5, 87);
    [light * (1.0 + 0.5 * warm), light, light * (1.0 - warm)]
}

/// The blade polishes what it presses.
pub fn plaster_roughness(p: Point) -> f64 {
    let (height, scratch) = strokes(p);
    0.90 + 0.08 * fractal(p, [4, 4], 3, 0.6, 88) - 0.8 * height + 0.05 * scratch + 0.1 * pits(p)
}

pub fn plaster_height(p: Point) -> f64 {
    let (height, scratch) = strokes(p);
    let sand = fractal(p, [60, 60], 2, 0.6, 89);
    0.050 * height + 0.0007 * scratch + 0.0006 * sand - 0.004 * pits(p)
        + 0.006 * fractal(p, [3, 3], 2, 0.5, 90)
}
