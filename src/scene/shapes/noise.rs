//! What random-looking numbers does a shape use, the same on every machine?
//!
//! Integer hashes and polynomial fades only: no tables, no transcendental functions.

use glam::{IVec3, Vec3};

/// Mixes 32 bits so that each input bit changes about half of the output bits
/// (the finaliser of MurmurHash3 by A. Appleby, public domain).
pub fn mix(mut bits: u32) -> u32 {
    bits ^= bits >> 16;
    bits = bits.wrapping_mul(0x85eb_ca6b);
    bits ^= bits >> 13;
    bits = bits.wrapping_mul(0xc2b2_ae35);
    bits ^ (bits >> 16)
}

/// The top 24 bits as a number in 0..1; 24 is what an `f32` holds exactly.
fn unit(bits: u32) -> f32 {
    (bits >> 8) as f32 / (1 << 24) as f32
}

fn lattice(cell: IVec3, seed: u32) -> u32 {
    let x = mix(cell.x as u32 ^ seed);
    let y = mix(cell.y as u32 ^ x);
    mix(cell.z as u32 ^ y)
}

/// The offset's product with one of Perlin's twelve edge directions ("Improving Noise", 2002).
fn slope(hash: u32, offset: Vec3) -> f32 {
    let (a, b) = match hash % 3 {
        0 => (offset.x, offset.y),
        1 => (offset.y, offset.z),
        _ => (offset.z, offset.x),
    };
    let a = if hash & 4 == 0 { a } else { -a };
    let b = if hash & 8 == 0 { b } else { -b };
    a + b
}

/// Gradient noise with a feature size of 1: about -1..1, mean 0, continuous second derivative.
pub fn gradient(p: Vec3, seed: u32) -> f32 {
    let base = p.floor();
    let cell = base.as_ivec3();
    let t = p - base;
    let fade = t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    let corner = |x: i32, y: i32, z: i32| {
        let step = IVec3::new(x, y, z);
        // Perlin's directions are picked by 4 bits; `>> 4` leaves the weaker low bits out.
        slope(lattice(cell + step, seed) >> 4, t - step.as_vec3())
    };
    let along_x = |y, z| corner(0, y, z) + (corner(1, y, z) - corner(0, y, z)) * fade.x;
    let along_y = |z| along_x(0, z) + (along_x(1, z) - along_x(0, z)) * fade.y;
    along_y(0) + (along_y(1) - along_y(0)) * fade.z
}

/// `octaves` layers of gradient noise, each twice as fine and half as high.
pub fn fractal(p: Vec3, octaves: u32, seed: u32) -> f32 {
    let mut sum = 0.0;
    let mut scale = 1.0;
    for octave in 0..octaves {
        sum += gradient(p * scale, seed.wrapping_add(octave)) / scale;
        scale *= 2.0;
    }
    sum
}

/// Distance to the nearest of a jittered point per unit cell (S. Worley, 1996), and the same
/// for the second nearest. Their difference is 0 on the borders between cells.
pub fn cellular(p: Vec3, seed: u32) -> (f32, f32) {
    let base = p.floor().as_ivec3();
    let (mut first, mut second) = (f32::MAX, f32::MAX);
    for n in 0..27 {
        let cell = base + IVec3::new(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
        let hash = lattice(cell, seed);
        let jitter = Vec3::new(unit(hash), unit(mix(hash)), unit(mix(hash ^ 0x9e37_79b9)));
        let distance = (cell.as_vec3() + jitter).distance_squared(p);
        second = second.min(distance.max(first));
        first = first.min(distance);
    }
    (first.sqrt(), second.sqrt())
}

/// A stream of random numbers for placing things.
pub struct Dice {
    state: u32,
}

impl Dice {
    /// Starts the stream named `seed`.
    pub fn new(seed: u32) -> Self {
        Self { state: mix(seed) }
    }

    /// The next number, `low..high`.
    pub fn range(&mut self, low: f32, high: f32) -> f32 {
        // Weyl's step: the golden ratio's fraction times 2^32, odd, so all states are visited.
        self.state = self.state.wrapping_add(0x9e37_79b9);
        low + (high - low) * unit(mix(self.state))
    }
}
