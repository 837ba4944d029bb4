//! What does the slides' Phong model reflect?

use glam::DVec3;

/// Lambert's term: the cosine to the light, not below 0.
pub fn diffuse(n: DVec3, l: DVec3) -> f64 {
    n.dot(l).max(0.0)
}

/// Phong 1975: the cosine between the mirrored light and the eye, to the power of `shininess` >= 0.
///
/// 0 where the light is at or below the surface, or that cosine is not positive.
pub fn specular(n: DVec3, l: DVec3, e: DVec3, shininess: f64) -> f64 {
    let mirrored = n * (2.0 * n.dot(l)) - l;
    let cos = mirrored.dot(e);
    if n.dot(l) <= 0.0 || cos <= 0.0 {
        0.0
    } else {
        cos.min(1.0).powf(shininess)
    }
}
