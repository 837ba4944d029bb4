//! What do the slides' listings give in 32 bits, depending on what `min` and `max` do with a NaN?
//!
//! Vulkan and GLSL leave it open, and devices differ. Three readings span them. What a device makes of the rest (its sine, its
//! arc cosine) is taken to be nearly exact here: what breaks is the listing's own.

#![allow(non_snake_case, reason = "the listing's own names, to the letter")]

use glam::Vec3;

/// What `min` and `max` give where one operand is NaN.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Reading {
    /// The other one: IEEE 754's minNum and maxNum, and most graphics cards.
    Dropped,
    /// What the text of GLSL says: `max(x, y)` is y if x < y, otherwise x.
    Text,
    /// NaN.
    Propagated,
}

impl Reading {
    /// All.
    pub const ALL: [Self; 3] = [Self::Dropped, Self::Text, Self::Propagated];

    fn max(self, x: f32, y: f32) -> f32 {
        self.choose(x, y, if x < y { y } else { x }, x.max(y))
    }

    fn min(self, x: f32, y: f32) -> f32 {
        self.choose(x, y, if y < x { y } else { x }, x.min(y))
    }

    fn choose(self, x: f32, y: f32, text: f32, dropped: f32) -> f32 {
        match self {
            Self::Dropped => dropped,
            Self::Text => text,
            Self::Propagated if x.is_nan() || y.is_nan() => f32::NAN,
            Self::Propagated => text,
        }
    }
}

/// NaN for a vector of no length.
fn normalize(v: Vec3) -> Vec3 {
    v / v.length()
}

/// As GLSL has it, exp2(y log2(x)): NaN for a negative x.
fn pow(x: f32, y: f32) -> f32 {
    (y * x.log2()).exp2()
}

/// The listing's `OrenNayar`.
pub fn oren_nayar(reading: Reading, N: Vec3, L: Vec3, E: Vec3, Roughness: f32) -> f32 {
    let (max, min) = (|x, y| reading.max(x, y), |x, y| reading.min(x, y));
    let NdL = max(0.0, N.dot(L));
    let NdE = max(0.0, N.dot(E));
    let R2 = Roughness * Roughness;

    let A = 1.0 - 0.5 * R2 / (R2 + 0.33);
    let B = 0.45 * R2 / (R2 + 0.09);

    let lightProjected = normalize(L - N * NdL);
    let viewProjected = normalize(E - N * NdE);
    let CX = max(0.0, lightProjected.dot(viewProjected));

    let alpha = max(NdE.acos(), NdL.acos()).sin();
    let beta = min(NdE.acos(), NdL.acos()).tan();
    let DX = alpha * beta;

    NdL * (A + B * CX * DX)
}

/// The listing's `CookTorrance`.
pub fn cook_torrance(
    reading: Reading,
    [N, L, E]: [Vec3; 3],
    Roughness: f32,
    FresnelScale: f32,
) -> f32 {
    let (max, min) = (|x, y| reading.max(x, y), |x, y| reading.min(x, y));
    let NdL = max(0.0, N.dot(L));
    let NdE = max(0.0, N.dot(E));
    let R2 = Roughness * Roughness;
    let H = normalize(L + E);
    let HdE = H.dot(E);

    let NdH = max(0.0, N.dot(H));
    let NdH2 = NdH * NdH;

    let exponent = -(1.0 - NdH2) / (NdH2 * R2);
    let D = pow(std::f32::consts::E, exponent) / (R2 * NdH2 * NdH2);

    let F = pow(1.0 - HdE, 5.0) * (1.0 - FresnelScale) + FresnelScale;

    let X = 2.0 * NdH / E.dot(H);
    let G = min(1.0, min(X * NdL, X * NdE));

    max((D * G * F) / (NdE * std::f32::consts::PI), 0.0)
}
