//! Where does a direction point, measured from a normal?

use glam::DVec3;

/// The unit direction at `theta` from +Z and `phi` from +X about +Z, both in radians.
pub fn spherical(theta: f64, phi: f64) -> DVec3 {
    let (sin_theta, cos_theta) = theta.sin_cos();
    let (sin_phi, cos_phi) = phi.sin_cos();
    DVec3::new(sin_theta * cos_phi, sin_theta * sin_phi, cos_theta)
}

/// The angle between two vectors that are not zero, in radians, 0 to pi.
///
/// From both sine and cosine: the arc cosine alone loses half the digits near 0 and pi.
pub fn angle(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b))
}

/// A right-handed frame of unit vectors: `normal`, and two tangents.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    pub tangent: DVec3,
    pub bitangent: DVec3,
    pub normal: DVec3,
}

impl Frame {
    /// The frame about the unit vector `normal` whose tangent is the projection of `towards`, or any
    /// tangent where `towards` is parallel to the normal.
    pub fn facing(normal: DVec3, towards: DVec3) -> Frame {
        let projected = towards - normal * normal.dot(towards);
        let tangent = projected
            .try_normalize()
            .unwrap_or_else(|| normal.any_orthonormal_vector());
        Frame {
            tangent,
            bitangent: normal.cross(tangent),
            normal,
        }
    }

    /// `local` (x along the tangent, z along the normal) in the frame's own space.
    pub fn at(&self, local: DVec3) -> DVec3 {
        self.tangent * local.x + self.bitangent * local.y + self.normal * local.z
    }
}
