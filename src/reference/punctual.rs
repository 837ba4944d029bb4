//! How much light arrives from one lamp, and from where?

use glam::DVec3;

/// A lamp nearer than this is on the surface point itself, has no direction and gives nothing, m.
pub const DISTANCE_MIN: f64 = 8.881784197001252e-16; // 2^-50
/// Nothing arrives from a lamp farther than this, m.
pub const DISTANCE_MAX: f64 = 9.223_372_036_854_776e18; // 2^63

/// Where a lamp is.
#[derive(Clone, Copy, Debug)]
pub enum Place {
    /// So far that only the unit direction to it counts.
    Towards(DVec3),
    /// At a position, m.
    At(DVec3),
}

/// One lamp: directional, point or spot.
#[derive(Clone, Copy, Debug)]
pub struct Light {
    pub place: Place,
    /// `At`: luminous intensity, cd. `Towards`: illuminance of a surface that faces it, lx.
    pub intensity: DVec3,
    /// `At`: the lamp's radius, m. `Towards`: tangent of its angular radius. > 0.
    pub radius: f64,
    /// Unit direction of a spot's beam.
    pub axis: DVec3,
    /// Falloff = clamp(cos * scale + offset, 0, 1)^2 with the cosine to the axis; 0 and 1 for no cone.
    pub cone_scale: f64,
    pub cone_offset: f64,
}

/// What arrives at a point.
#[derive(Clone, Copy, Debug)]
pub struct Incident {
    /// Unit direction to the lamp.
    pub l: DVec3,
    /// On a surface that faces the lamp, lx.
    pub illuminance: DVec3,
    /// The lamp's radius over its distance, at most 1: nearly its angular radius, radians.
    pub angular_radius: f64,
}

/// Scale and offset of a cone with full light within `inner` and none beyond `outer`, 0 <= inner < outer <= pi,
/// radians from the axis (Lagarde and de Rousiers 2014, listing 4).
pub fn cone(inner: f64, outer: f64) -> (f64, f64) {
    let scale = 1.0 / (inner.cos() - outer.cos());
    (scale, -outer.cos() * scale)
}

impl Light {
    /// What arrives at `point`; `None` where nothing does.
    pub fn at(&self, point: DVec3) -> Option<Incident> {
        let (l, distance) = match self.place {
            Place::Towards(direction) => (direction.try_normalize()?, 1.0),
            Place::At(position) => {
                let to_lamp = position - point;
                (to_lamp.try_normalize()?, to_lamp.length())
            }
        };
        if !(DISTANCE_MIN..=DISTANCE_MAX).contains(&distance) {
            return None;
        }
        let falloff = (self.cone_offset - self.axis.dot(l) * self.cone_scale)
            .clamp(0.0, 1.0)
            .powi(2);
        if falloff == 0.0 {
            return None;
        }
        let nearest = distance.max(self.radius);
        Some(Incident {
            l,
            illuminance: self.intensity * (falloff / (nearest * nearest)),
            angular_radius: (self.radius / distance).min(1.0),
        })
    }
}
