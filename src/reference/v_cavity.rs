//! How much of a facet is neither shadowed nor masked? Torrance and Sparrow 1967, V-cavities.

use glam::DVec3;

/// min(1, 2 (N.H)(N.E) / (E.H), 2 (N.H)(N.L) / (E.H)), 0 for a light or an eye at or below the surface.
pub fn g(n: DVec3, l: DVec3, e: DVec3) -> f64 {
    if n.dot(l) <= 0.0 || n.dot(e) <= 0.0 {
        return 0.0;
    }
    let h = (l + e).normalize();
    let scale = 2.0 * n.dot(h) / e.dot(h);
    (scale * n.dot(e)).min(scale * n.dot(l)).min(1.0)
}
