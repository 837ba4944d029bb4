//! Where on the screen does a point of the world land?

// "directx": y up and depth 0..1 in clip space; the viewport turns y over.
use glam::camera::rh::{proj::directx as to_clip, view};
use glam::{DVec3, Mat4, Vec3, Vec4};

use crate::scene::{Bounds, Camera, Projection};

/// The near plane's distance as a share of the distance to the camera's target. Reversed floating
/// depth loses nothing by a small one (its relative precision is that of f32 at any distance), so it
/// only has to be nearer than anything one would look at.
const NEAR_SHARE: f32 = 1e-3;

/// World to clip space, for a picture `aspect` times as wide as high: depth 1 at the near plane, 0
/// at infinity (or, orthographic, behind `bounds`).
pub fn view_projection(camera: &Camera, aspect: f32, bounds: &Bounds) -> Mat4 {
    let view = view::look_at_mat4(camera.position, camera.target, camera.up);
    let projection = match camera.projection {
        Projection::Perspective {
            vertical_fov_degrees,
        } => {
            let near = camera.position.distance(camera.target) * NEAR_SHARE;
            to_clip::perspective_infinite_reverse(vertical_fov_degrees.to_radians(), aspect, near)
        }
        Projection::Orthographic { height } => {
            let (half_width, half_height) = (0.5 * height * aspect, 0.5 * height);
            let depth = depth_of(camera, bounds);
            // Near and far stand exchanged: depth is reversed.
            to_clip::orthographic(
                -half_width,
                half_width,
                -half_height,
                half_height,
                depth,
                0.0,
            )
        }
    };
    projection * view
}

/// The eye as the shaders want it: a position, or for parallel rays the direction to it.
pub fn eye(camera: &Camera) -> Vec4 {
    match camera.projection {
        Projection::Perspective { .. } => camera.position.extend(1.0),
        Projection::Orthographic { .. } => (-forward(camera)).extend(0.0),
    }
}

/// The corners of what the camera may see of `bounds`: at the eye, and at the depth of the farthest point.
pub fn frustum(camera: &Camera, aspect: f32, bounds: &Bounds) -> [DVec3; 8] {
    let eye = camera.position.as_dvec3();
    let ahead = (camera.target - camera.position).as_dvec3().normalize();
    let right = ahead.cross(camera.up.as_dvec3()).normalize_or(DVec3::X);
    let up = right.cross(ahead);
    let depth = f64::from(depth_of(camera, bounds));
    let half_height = |depth: f64| match camera.projection {
        Projection::Perspective {
            vertical_fov_degrees,
        } => depth * (0.5 * f64::from(vertical_fov_degrees).to_radians()).tan(),
        Projection::Orthographic { height } => 0.5 * f64::from(height),
    };
    std::array::from_fn(|corner| {
        let sign = |bit: usize| if corner >> bit & 1 == 0 { -1.0 } else { 1.0 };
        let depth = if corner >> 2 & 1 == 0 { 0.0 } else { depth };
        let up = up * (sign(1) * half_height(depth));
        let right = right * (sign(0) * half_height(depth) * f64::from(aspect));
        eye + ahead * depth + up + right
    })
}

/// How far a point lies from the eye, along the view; orders what is transparent.
pub fn distance(camera: &Camera, point: Vec3) -> f32 {
    match camera.projection {
        Projection::Perspective { .. } => point.distance(camera.position),
        Projection::Orthographic { .. } => (point - camera.position).dot(forward(camera)),
    }
}

fn forward(camera: &Camera) -> Vec3 {
    (camera.target - camera.position).normalize()
}

/// The distance from the eye's plane to behind everything; at least to the target.
fn depth_of(camera: &Camera, bounds: &Bounds) -> f32 {
    let to_center = (bounds.center() - camera.position).dot(forward(camera));
    let behind = to_center + bounds.radius();
    behind.max(camera.position.distance(camera.target)) * 1.01
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera(projection: Projection) -> Camera {
        Camera {
            position: Vec3::new(0.0, 0.0, 5.0),
            target: Vec3::ZERO,
            up: Vec3::Y,
            projection,
            exposure_ev100: 0.0,
        }
    }

    fn bounds() -> Bounds {
        Bounds {
            min: Vec3::splat(-1.0),
            max: Vec3::splat(1.0),
        }
    }

    #[test]
    fn up_is_up_right_is_right_and_near_is_larger() {
        for projection in [
            Projection::Perspective {
                vertical_fov_degrees: 90.0,
            },
            Projection::Orthographic { height: 10.0 },
        ] {
            let matrix = view_projection(&camera(projection), 2.0, &bounds());
            let center = matrix.project_point3(Vec3::ZERO);
            assert!(center.truncate().length() < 1e-6, "{projection:?}");
            assert!(matrix.project_point3(Vec3::X).x > 0.0);
            assert!(matrix.project_point3(Vec3::Y).y > 0.0);
            // 5 m away at 90 degrees, or half of 10 m: one metre is a fifth of half the height.
            assert!((matrix.project_point3(Vec3::Y).y - 0.2).abs() < 1e-6);
            assert!((matrix.project_point3(Vec3::X).x - 0.1).abs() < 1e-6);
            let nearer = matrix.project_point3(Vec3::Z).z;
            let farther = matrix.project_point3(-Vec3::Z).z;
            assert!(
                nearer > farther && farther > 0.0 && nearer < 1.0,
                "{projection:?}"
            );
        }
    }

    #[test]
    fn an_orthographic_eye_is_a_direction() {
        let eye = eye(&camera(Projection::Orthographic { height: 1.0 }));
        assert_eq!(eye, Vec4::new(0.0, 0.0, 1.0, 0.0));
    }
}
