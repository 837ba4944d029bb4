//! What random-looking functions repeat on a square without a seam?
//!
//! A point is (u, v), v up; all functions have period 1 in both. Integer hashes and polynomial
//! fades only, so that every machine finds the same numbers.

/// A point of the square.
pub type Point = [f64; 2];

/// The finaliser of MurmurHash3 (A. Appleby, public domain).
pub fn mix(mut bits: u32) -> u32 {
    bits ^= bits >> 16;
    bits = bits.wrapping_mul(0x85eb_ca6b);
    bits ^= bits >> 13;
    bits = bits.wrapping_mul(0xc2b2_ae35);
    bits ^ (bits >> 16)
}

/// A hash as a number in 0..1, the `salt`-th of its kind.
pub fn unit(hash: u32, salt: u32) -> f64 {
    f64::from(mix(hash.wrapping_add(salt.wrapping_mul(0x9e37_79b9))) >> 8) / f64::from(1 << 24)
}

/// The hash of a lattice cell; cells repeat after `cells`.
fn lattice(cell: [i64; 2], cells: [u32; 2], seed: u32) -> u32 {
    let [x, y] = [0, 1].map(|k| cell[k].rem_euclid(i64::from(cells[k])) as u32);
    mix(y ^ mix(x ^ mix(seed ^ 0x9e37_79b9)))
}

/// 0 below `low`, 1 above `high`, smooth between.
pub fn step(low: f64, high: f64, x: f64) -> f64 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

pub fn lerp(a: f64, b: f64, t: f64) -> f64 {
    a + (b - a) * t
}

/// The cell that holds `p`, and where in it `p` is.
fn split(p: Point, cells: [u32; 2]) -> ([i64; 2], Point) {
    let scaled = [0, 1].map(|k| p[k] * f64::from(cells[k]));
    let base = scaled.map(f64::floor);
    (
        base.map(|x| x as i64),
        [scaled[0] - base[0], scaled[1] - base[1]],
    )
}

/// Gradient noise with one feature per cell: about -1..1, mean 0.
pub fn noise(p: Point, cells: [u32; 2], seed: u32) -> f64 {
    let ([x, y], [s, t]) = split(p, cells);
    let corner = |dx: i64, dy: i64| {
        let hash = lattice([x + dx, y + dy], cells, seed);
        let slope = [unit(hash, 1) * 2.0 - 1.0, unit(hash, 2) * 2.0 - 1.0];
        slope[0] * (s - dx as f64) + slope[1] * (t - dy as f64)
    };
    let fade = |t: f64| t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    let low = lerp(corner(0, 0), corner(1, 0), fade(s));
    let high = lerp(corner(0, 1), corner(1, 1), fade(s));
    1.6 * lerp(low, high, fade(t))
}

/// `octaves` layers of noise, each twice as fine and `gain` times as high; about -1..1.
pub fn fractal(p: Point, cells: [u32; 2], octaves: u32, gain: f64, seed: u32) -> f64 {
    let (mut sum, mut height, mut all) = (0.0, 1.0, 0.0);
    for octave in 0..octaves {
        sum += height * noise(p, cells.map(|n| n << octave), seed.wrapping_add(octave));
        all += height;
        height *= gain;
    }
    sum / all
}

/// Visits the nine scattered points around `p`, one per cell: the way from it to `p` in cells, and
/// its hash. `jitter` 0 puts each into the middle of its cell.
pub fn around(
    p: Point,
    cells: [u32; 2],
    jitter: f64,
    seed: u32,
    mut visit: impl FnMut(Point, u32),
) {
    let ([x, y], [s, t]) = split(p, cells);
    for n in 0..9 {
        let (dx, dy) = (n % 3 - 1, n / 3 - 1);
        let hash = lattice([x + dx, y + dy], cells, seed);
        let place = |salt| 0.5 + jitter * (unit(hash, salt) - 0.5);
        visit([s - dx as f64 - place(3), t - dy as f64 - place(4)], hash);
    }
}

/// Distances to the nearest and the next of the scattered points, in cells, and the nearest's hash.
pub fn cellular(p: Point, cells: [u32; 2], jitter: f64, seed: u32) -> (f64, f64, u32) {
    let mut found = (f64::MAX, f64::MAX, 0);
    around(p, cells, jitter, seed, |[dx, dy], hash| {
        let distance = dx * dx + dy * dy;
        if distance < found.0 {
            found = (distance, found.0, hash);
        } else {
            found.1 = found.1.min(distance);
        }
    });
    (found.0.sqrt(), found.1.sqrt(), found.2)
}
