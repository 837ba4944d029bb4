//! What do the surroundings send: a sky above the horizon, a ground below it?

use glam::DVec3;

/// Radiance from above and from below the horizon (+Y is up), cd/m^2.
#[derive(Clone, Copy, Debug)]
pub struct Surroundings {
    pub sky: DVec3,
    pub ground: DVec3,
}

/// Mean radiance over the cosine-weighted hemisphere about `n`: a plane tilted by t sees the share
/// (1 + cos t) / 2 of the sky. Times an albedo it is Lambert's radiance.
pub fn mean_radiance(around: &Surroundings, n: DVec3) -> DVec3 {
    around.ground.lerp(around.sky, (1.0 + n.y) / 2.0)
}

/// Radiance that the facets of roughness m > 0 mirror to `e`: an approximation, see `sky_share`.
pub fn mirrored_radiance(around: &Surroundings, n: DVec3, e: DVec3, m: f64) -> DVec3 {
    around.ground.lerp(around.sky, sky_share(n, e, DVec3::Y, m))
}

/// How much of what the facets mirror to `e` comes from above the horizon of `up`, 0..1.
///
/// The mirror direction, lifted towards the normal because facets send nothing below the surface, sees the
/// horizon as a step of width 0.8 m. Fitted to the Cook-Torrance lobe: within 0.17, root mean square 0.06.
pub fn sky_share(n: DVec3, e: DVec3, up: DVec3, m: f64) -> f64 {
    let cos = n.dot(e);
    let mirror = n * (2.0 * cos) - e;
    let lifted = mirror + n * (1.5 * m * m / (m + cos.max(0.0)));
    let height = lifted.dot(up);
    (1.0 + height / height.hypot(0.8 * m * lifted.length())) / 2.0
}
