//! How does a smooth matte surface scatter? Lambert 1760.

use glam::DVec3;

/// pi f cos(theta_l) for albedo 1. 0 for a light at or below the surface.
pub fn lobe(n: DVec3, l: DVec3) -> f64 {
    n.dot(l).max(0.0)
}
