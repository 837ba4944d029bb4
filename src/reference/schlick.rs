//! How much does an interface reflect? Schlick 1994, with a colour at normal incidence.

use glam::DVec3;

/// Reflectance at grazing: 1, but falling to 0 with an f0 below 0.02 (Lagarde and de Rousiers 2014): no
/// interface, no reflection.
pub fn f90(f0: DVec3) -> f64 {
    (50.0 * f0.max_element()).min(1.0)
}

/// f0 + (f90 - f0)(1 - cos)^5. A cosine beyond 0..1 counts as the nearer end.
pub fn f(f0: DVec3, cos: f64) -> DVec3 {
    rise(f0, DVec3::splat(f90(f0)), cos)
}

/// Reflectance of an interface of roughness m for light from all around (Lagarde 2011): the rise ends at
/// f90 (1 - m), or at f0 where that is more.
pub fn f_rough(f0: DVec3, m: f64, cos: f64) -> DVec3 {
    rise(f0, DVec3::splat(f90(f0) * (1.0 - m)).max(f0), cos)
}

fn rise(from: DVec3, to: DVec3, cos: f64) -> DVec3 {
    from + (to - from) * (1.0 - cos.clamp(0.0, 1.0)).powi(5)
}
