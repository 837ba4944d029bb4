//! How do functions on a square become texels, normals and occlusion?

use super::torus::Point;

/// The middle of a texel; row 0 is the top, v is up.
fn middle(x: u32, y: u32, size: [u32; 2]) -> Point {
    let u = (f64::from(x) + 0.5) / f64::from(size[0]);
    let v = 1.0 - (f64::from(y) + 0.5) / f64::from(size[1]);
    [u, v]
}

/// A function's values, row by row from the top.
pub fn sample<T>(size: [u32; 2], at: impl Fn(Point) -> T) -> Vec<T> {
    let texels = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (x, y)));
    texels.map(|(x, y)| at(middle(x, y, size))).collect()
}

/// Heights of a picture that repeats, in units of its side.
pub struct Relief {
    size: [u32; 2],
    heights: Vec<f64>,
}

/// In how many directions the horizon is looked for, and how far, in parts of the picture's side.
const DIRECTIONS: u32 = 24;
const REACH: f64 = 0.30;

impl Relief {
    pub fn new(size: [u32; 2], height: impl Fn(Point) -> f64) -> Self {
        let heights = sample(size, height);
        Self { size, heights }
    }

    fn at(&self, x: i64, y: i64) -> f64 {
        let [width, height] = self.size.map(i64::from);
        self.heights[(y.rem_euclid(height) * width + x.rem_euclid(width)) as usize]
    }

    fn texels(&self) -> impl Iterator<Item = (i64, i64)> {
        let [width, height] = self.size.map(i64::from);
        (0..height).flat_map(move |y| (0..width).map(move |x| (x, y)))
    }

    /// Unit normals by central differences, y up.
    pub fn normals(&self) -> Vec<[f64; 3]> {
        let [per_u, per_v] = self.size.map(|texels| 0.5 * f64::from(texels));
        let normal = |(x, y): (i64, i64)| {
            let across = (self.at(x + 1, y) - self.at(x - 1, y)) * per_u;
            let upward = (self.at(x, y - 1) - self.at(x, y + 1)) * per_v;
            let length = (across * across + upward * upward + 1.0).sqrt();
            [-across / length, -upward / length, 1.0 / length]
        };
        self.texels().map(normal).collect()
    }

    /// The tangent of the horizon's height as seen from a texel in a direction.
    fn horizon(&self, (x, y): (i64, i64), direction: u32) -> f64 {
        let turn = std::f64::consts::TAU * f64::from(direction) / f64::from(DIRECTIONS);
        let (sin, cos) = turn.sin_cos();
        let (own, mut highest) = (self.at(x, y), 0.0_f64);
        let [width, height] = self.size.map(f64::from);
        for step in 1..=(REACH * width.max(height)) as i64 {
            let [dx, dy] = [cos, sin].map(|part| (part * step as f64).round());
            let (across, upward) = (dx / width, dy / height);
            let distance = (across * across + upward * upward).sqrt();
            let rise = self.at(x + dx as i64, y + dy as i64) - own;
            highest = highest.max(rise / distance);
        }
        highest
    }

    /// The share of an even sky's light that arrives on the level: of each direction the square of
    /// the cosine of its horizon.
    pub fn occlusion(&self) -> Vec<f64> {
        let open = |texel| {
            let shares = (0..DIRECTIONS).map(|direction| {
                let tangent = self.horizon(texel, direction);
                1.0 / (1.0 + tangent * tangent)
            });
            shares.sum::<f64>() / f64::from(DIRECTIONS)
        };
        self.texels().map(open).collect()
    }
}
