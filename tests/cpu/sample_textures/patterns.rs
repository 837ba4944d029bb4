//! Which patterns do the small sample maps show: tiles, damask, inlay, studs, a sign, embers, lace?

use super::torus::{Point, cellular, fractal, lerp, noise, step, unit};

/// Where a point lies in one of `count` x `count` squares: -1..1 in both.
fn square(p: Point, count: u32) -> Point {
    p.map(|k| {
        let scaled = k * f64::from(count);
        2.0 * (scaled - scaled.floor()) - 1.0
    })
}

fn length([x, y]: Point) -> f64 {
    (x * x + y * y).sqrt()
}

/// 1 inside an outline, 0 outside: `outside` is the distance to it, `soft` half the edge's width.
fn inside(outside: f64, soft: f64) -> f64 {
    1.0 - step(-soft, soft, outside)
}

/// The distance to a star of `points` rays: a polygon {points/2}, two squares or more turned.
fn star(p: Point, squares: u32, size: f64) -> f64 {
    let distances = (0..squares).map(|n| {
        let turn = std::f64::consts::FRAC_PI_2 * f64::from(n) / f64::from(squares);
        let (sin, cos) = turn.sin_cos();
        let [x, y] = [cos * p[0] + sin * p[1], cos * p[1] - sin * p[0]];
        x.abs().max(y.abs()) - size
    });
    distances.fold(f64::MAX, f64::min)
}

/// The corners of a square as one place: (0, 0) there, 1 along an edge's half.
fn corner([x, y]: Point) -> Point {
    [1.0 - x.abs(), 1.0 - y.abs()]
}

/// Painted tiles, two by two: blue and yellow on a white glaze.
pub fn tile_color(p: Point) -> [f64; 3] {
    let soft = 0.016;
    let q = square(p, 2);
    let (r, c) = (length(q), length(corner(q)));
    let white = [0.92, 0.91, 0.87].map(|k| k * (1.0 + 0.04 * fractal(p, [4, 4], 3, 0.5, 101)));
    // The brush leaves more paint here than there.
    let load = 0.85 + 0.35 * fractal(p, [12, 12], 3, 0.6, 102);
    let (blue, yellow) = ([0.03, 0.10, 0.42].map(|k| k * load), [0.86, 0.52, 0.08]);
    let petals = r - 0.46 - 0.16 * (8.0 * q[1].atan2(q[0])).cos();
    let layers = [
        (star(q, 2, 0.62), blue),
        (star(q, 2, 0.55), white),
        (petals, blue),
        (r - 0.25, yellow),
        (r - 0.18, white),
        (r - 0.11, blue),
        ((c - 0.42).abs() - 0.05, blue),
        (c - 0.28, yellow),
        (c - 0.17, blue),
    ];
    let mut color = white;
    for (outside, paint) in layers {
        let share = inside(outside, soft);
        color = [0, 1, 2].map(|k| lerp(color[k], paint[k], share));
    }
    let joint = inside(0.965 - q[0].abs().max(q[1].abs()), soft);
    color.map(|k| lerp(k, 0.45, joint))
}

/// Damask: what is etched matt into polished metal. A lattice of ogees, a flower in each.
pub fn damask_roughness(p: Point) -> f64 {
    let soft = 0.03;
    // Two lattices, each in the other's gaps.
    let flower = |q: Point| {
        let r = length(q);
        let turn = q[1].atan2(q[0]);
        let leaves = r - 0.34 - 0.15 * (4.0 * turn).cos();
        let bud = (r - 0.13).abs() - 0.035;
        let veins = (2.0 * turn).sin().abs() * r - 0.028;
        inside(leaves, soft)
            * (1.0 - inside(bud, soft))
            * (1.0 - inside(veins, soft) * step(0.16, 0.2, r))
    };
    let q = square(p, 2);
    let other = square([p[0] + 0.25, p[1] + 0.25], 2);
    let ogee = (q[0].abs() + q[1].abs() - 1.0
        + 0.10 * (std::f64::consts::TAU * (q[0].abs() - q[1].abs()) / 2.0).cos())
    .abs();
    let band = inside((ogee - 0.11).abs() - 0.022, 0.5 * soft);
    let etched = flower(q).max(flower(other)).max(band);
    let grain = 0.06 * noise(p, [64, 64], 103);
    lerp(0.16, 0.94 + grain, etched).clamp(0.0, 1.0)
}

/// Metal inlaid into enamel: stars of eight points and the bands between them.
pub fn inlay_metalness(p: Point) -> f64 {
    let soft = 0.02;
    let q = square(p, 2);
    let c = corner(q);
    let outline = |distance: f64, width: f64| inside(distance.abs() - width, soft);
    let [x, y] = [q[0].abs(), q[1].abs()];
    let spokes = (x.min(y) - 0.0)
        .abs()
        .min((x - y).abs() / std::f64::consts::SQRT_2);
    let beyond = step(0.60, 0.62, star(q, 2, 0.0));
    let parts = [
        outline(star(q, 2, 0.56), 0.035),
        inside(star(q, 2, 0.22), soft),
        outline(star(q, 4, 0.36), 0.02),
        inside(spokes - 0.03, soft) * beyond * step(0.42, 0.46, length(c)),
        outline(star(c, 2, 0.30), 0.03),
        inside(length(c) - 0.12, soft),
    ];
    parts.into_iter().fold(0.0, f64::max)
}

/// Square plates with bevelled edges and a stud in the middle, two by two.
pub fn stud_height(p: Point) -> f64 {
    let q = square(p, 2);
    let edge = 1.0 - q[0].abs().max(q[1].abs());
    let plate = step(0.05, 0.22, edge);
    let r = length(q) / 0.52;
    let dome = (1.0 - r * r).max(0.0).sqrt();
    // In units of half a plate, then of the picture's side.
    (0.28 * plate + 0.36 * dome) / 4.0
}

/// Dots of the sign in each direction; its picture has eight texels a dot.
pub const DOTS: [u32; 2] = [32, 16];
/// Seven rows of letters of five columns, a bit a dot.
const LETTERS: [[u8; 7]; 5] = [
    [0x11, 0x11, 0x11, 0x11, 0x11, 0x11, 0x0e],
    [0x11, 0x1b, 0x15, 0x15, 0x11, 0x11, 0x11],
    [0x1e, 0x11, 0x11, 0x1e, 0x11, 0x11, 0x1e],
    [0x1f, 0x10, 0x10, 0x1e, 0x10, 0x10, 0x1f],
    [0x1e, 0x11, 0x11, 0x1e, 0x14, 0x12, 0x11],
];

/// The colour of a lamp of the sign, from the left and from the top.
fn lamp(column: u32, row: u32) -> [f64; 3] {
    let (amber, blue) = ([1.0, 0.36, 0.02], [0.03, 0.30, 1.0]);
    let (left, top) = (column.wrapping_sub(1), row.wrapping_sub(4));
    if let Some(letter) = LETTERS.get((left / 6) as usize)
        && let Some(line) = letter.get(top as usize)
        && left % 6 < 5
        && line >> (4 - left % 6) & 1 == 1
    {
        return amber;
    }
    match row {
        1 | 13 => blue.map(|k| k * if (column + row) % 4 < 2 { 1.0 } else { 0.12 }),
        _ => [0.010, 0.008, 0.006],
    }
}

/// A sign of round lamps that says the program's name between two running lights.
pub fn sign_emission(p: Point) -> [f64; 3] {
    let at = [p[0] * f64::from(DOTS[0]), (1.0 - p[1]) * f64::from(DOTS[1])];
    let cell = at.map(f64::floor);
    let off = [0, 1].map(|k| 2.0 * (at[k] - cell[k]) - 1.0);
    let glow = inside(length(off) - 0.72, 0.16);
    let core = 0.72 + 0.28 * inside(length(off) - 0.36, 0.3);
    lamp(cell[0] as u32, cell[1] as u32).map(|k| k * glow * core)
}

/// Embers: what glows between crusts, far brighter than white in the cracks.
pub fn ember_emission(p: Point) -> [f64; 3] {
    let bend = [111, 112].map(|seed| 0.03 * fractal(p, [6, 6], 3, 0.6, seed));
    let q = [p[0] + bend[0], p[1] + bend[1]];
    let (first, second, hash) = cellular(q, [5, 5], 0.95, 113);
    let crack = (-(second - first) * 9.0).exp();
    let draught = (0.55 + 0.75 * fractal(p, [2, 2], 3, 0.6, 114)).max(0.0);
    let crust = 0.02 + 0.05 * unit(hash, 5) * (1.0 + noise(p, [24, 24], 115));
    let heat = crust + 1.5 * crack * draught;
    // Towards yellow and white as it gets hotter.
    [9.0 * heat, 4.0 * heat * heat, 1.0 * heat * heat * heat]
}

/// Lace: 1 on the thread, 0 in the holes, 0.5 at their edges.
pub fn lace_alpha(p: Point) -> f64 {
    let q = square(p, 2);
    let r = length(q);
    let turn = q[1].atan2(q[0]);
    let c = length(corner(q));
    let ring = |at: f64, width: f64| width - (r - at).abs();
    let scallops = 0.86 + 0.05 * (16.0 * turn).cos();
    let petals = 0.33 + 0.19 * (8.0 * turn).cos();
    let spokes = 0.035 - (8.0 * turn).sin().abs() * r / 8.0;
    let net = 0.05 - (0.5 * (14.0 * q[0]).sin().abs()).min(0.5 * (14.0 * q[1]).sin().abs());
    let parts = [
        ring(scallops, 0.045),
        ring(0.74, 0.03),
        // Petals, each with an eyelet.
        (petals - r).min(length([r - 0.38, 0.38 * (8.0 * turn / 2.0).sin() / 4.0]) - 0.05),
        if r < 0.76 { spokes } else { -1.0 },
        if r > 0.86 { net } else { -1.0 },
        0.04 - (c - 0.24).abs(),
        0.10 - c,
    ];
    let thread = parts.into_iter().fold(-1.0, f64::max);
    (0.5 + 14.0 * thread).clamp(0.0, 1.0)
}
