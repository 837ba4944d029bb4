//! From where does each lamp see the scene, and what of it?
//!
//! A directional or spot light has one depth map, a point light (or a spot wider than
//! [`WIDEST_SPOT_DEGREES`]) the six faces of a cube. Depth is reversed, as in the picture.

use glam::dcamera::rh::{proj::directx as to_clip, view};
use glam::{DMat4, DVec3, DVec4, Vec3};

use super::camera;
use super::draw_list::{Draw, DrawList, TooMany};
use crate::interface::ShadowMap;
use crate::scene::{Bounds, Light, LightKind, Mesh, Scene};

/// A spot whose cone is wider has a cube: at 60 degrees a texel at the map's edge is four times as large as
/// in its middle (1 / cos^2), and grows without bound towards 90.
const WIDEST_SPOT_DEGREES: f32 = 60.0;

/// What all maps together take, bytes, while each is at least `SMALLEST_SIDE` wide.
const MOST_BYTES: u64 = 256 << 20;
/// A map's largest side, texels: at 1280 x 720 no picture shows a finer edge of a shadow that fills it.
const LARGEST_SIDE: u32 = 2048;
/// A coarser map is of no use.
const SMALLEST_SIDE: u32 = 256;

/// How much wider than what it is for a map is: at least two texels beyond each edge, so that the texels around a point, and
/// those farther out, are on it. Of a cube's face half the width is 1 at the distance 1.
const MARGIN: f64 = 1.0 + 4.0 / SMALLEST_SIDE as f64;

/// A lamp's depth is near / distance, known to 2^-20: at the far end of its reach that is 2^-20 reach^2 / near, with a near
/// plane of reach / 256 a quarter of a thousandth of the reach. What is nearer throws no shadow.
const NEAR_SHARE: f64 = 1.0 / 256.0;

/// The most draws to all maps together: four million are a second or more on any device.
const MOST_DRAWS: usize = 4 << 20;

/// The maps of a scene.
pub struct ShadowMaps {
    /// One for each layer.
    pub maps: Vec<ShadowMap>,
    /// For each light its first map, and how many it has: 0, 1 or 6.
    pub of_light: Vec<(u32, u32)>,
    /// What is drawn to each map.
    pub draws: Vec<Vec<Draw>>,
}

impl ShadowMaps {
    /// The maps of the lights that `casts` chooses, for a picture of this aspect.
    ///
    /// # Errors
    /// More draws than any device would do.
    pub fn new(
        scene: &Scene,
        list: &DrawList,
        aspect: f32,
        casts: impl Fn(&Light) -> bool,
    ) -> Result<Self, TooMany> {
        let mut all = Self {
            maps: Vec::new(),
            of_light: vec![(0, 0); scene.lights.len()],
            draws: Vec::new(),
        };
        let lights = all.of_light.iter_mut().zip(&scene.lights);
        let lights: Vec<_> = lights.filter(|(_, light)| casts(light)).collect();
        if lights.is_empty() {
            return Ok(all);
        }
        let around = Around::new(scene, list, aspect);
        let mut count = 0;
        for (maps, light) in lights {
            let clips = around.views(light);
            // At most six for each of `MAX_LIGHTS`.
            *maps = (all.maps.len() as u32, clips.len() as u32);
            for clip in &clips {
                let first = all.maps.len() as u32 * scene.objects.len() as u32;
                let draws = drawn(&around.casters, clip, first);
                count += draws.len();
                if count > MOST_DRAWS {
                    let what = "draws to shadow maps";
                    return Err(TooMany::new(count as u64, what, MOST_DRAWS as u64));
                }
                all.maps.push(record(clip));
                all.draws.push(draws);
            }
        }
        Ok(all)
    }

    /// The side of each map, texels: a power of two, as large as all together may be.
    pub fn side(&self) -> u32 {
        let layers = self.maps.len().max(1) as u64;
        let mut side = LARGEST_SIDE;
        while side > SMALLEST_SIDE && layers * u64::from(side).pow(2) * 4 > MOST_BYTES {
            side /= 2;
        }
        side
    }
}

fn record(clip: &DMat4) -> ShadowMap {
    ShadowMap {
        clip: clip.as_mat4().to_cols_array_2d(),
        planes: clip.inverse().transpose().as_mat4().to_cols_array_2d(),
    }
}

/// What lamps see: the scene, what throws shadows in it, and what the camera sees of it.
struct Around<'a> {
    scene: &'a Scene,
    aspect: f32,
    bounds: Bounds,
    casters: Vec<Caster>,
}

impl<'a> Around<'a> {
    fn new(scene: &'a Scene, list: &DrawList, aspect: f32) -> Self {
        Self {
            scene,
            aspect,
            bounds: scene.bounds(),
            casters: casters(scene, list),
        }
    }

    /// World to clip space of each map of a light.
    fn views(&self, light: &Light) -> Vec<DMat4> {
        match light.kind {
            LightKind::Directional { direction, .. } => {
                vec![parallel(direction.as_dvec3(), self)]
            }
            LightKind::Spot {
                position,
                direction,
                radius,
                outer_degrees,
                ..
            } if outer_degrees <= WIDEST_SPOT_DEGREES => {
                let angle = 2.0 * f64::from(outer_degrees).to_radians();
                let near = self.near(position, radius);
                vec![cone(position, direction.as_dvec3(), angle, near)]
            }
            LightKind::Spot {
                position, radius, ..
            }
            | LightKind::Point {
                position, radius, ..
            } => {
                let near = self.near(position, radius);
                let face = |face: &DVec3| cone(position, *face, 2.0 * MARGIN.atan(), near);
                FACES.iter().map(face).collect()
            }
        }
    }

    /// The near plane of a lamp: as far as nothing that throws a shadow is lost, at least its radius, since what stands in
    /// the lamp throws none, and at least the share of its reach that `NEAR_SHARE` is.
    fn near(&self, position: Vec3, radius: f32) -> f64 {
        let position = position.as_dvec3();
        let boxes = self
            .casters
            .iter()
            .map(|Caster { around, .. }| position.distance(position.clamp(around.min, around.max)));
        let nearest = boxes.fold(f64::INFINITY, f64::min);
        let corners = self.bounds.corners();
        let reach = corners
            .map(|corner| corner.as_dvec3().distance(position))
            .fold(0.0, f64::max);
        // Along the view a point is at no less than cos of its distance: 1 / sqrt(3) in a cube's corner, 1 / 2 at 60 degrees.
        let before_nearest = nearest.min(reach) * 0.5;
        before_nearest
            .max(f64::from(radius))
            .max(reach * NEAR_SHARE)
    }
}

/// The faces of a cube, in the order of `cube_face` in `shaders-glsl/effects/shadow.glsl`.
const FACES: [DVec3; 6] = [
    DVec3::X,
    DVec3::NEG_X,
    DVec3::Y,
    DVec3::NEG_Y,
    DVec3::Z,
    DVec3::NEG_Z,
];

/// Any direction that is not along `forward`.
fn up_for(forward: DVec3) -> DVec3 {
    if forward.y.abs() < 0.9 {
        DVec3::Y
    } else {
        DVec3::X
    }
}

/// The view from a lamp, `angle` wide each way, radians, from `near` on, m.
fn cone(position: Vec3, forward: DVec3, angle: f64, near: f64) -> DMat4 {
    let view = view::look_to_mat4(position.as_dvec3(), forward, up_for(forward));
    to_clip::perspective_infinite_reverse(angle, 1.0, near) * view
}

/// The view along parallel rays: across them it holds what the camera may see of the scene, along them all
/// of the scene.
fn parallel(forward: DVec3, around: &Around) -> DMat4 {
    let Around {
        scene,
        aspect,
        bounds,
        ..
    } = around;
    let center = bounds.center().as_dvec3();
    let view = view::look_to_mat4(center, forward, up_for(forward));
    let all = Box3::around(
        bounds
            .corners()
            .map(|c| view.transform_point3(c.as_dvec3())),
    );
    let seen = camera::frustum(&scene.camera, *aspect, bounds);
    let seen = Box3::around(seen.into_iter().map(|c| view.transform_point3(c)));
    let (min, max) = (all.min.max(seen.min), all.max.min(seen.max));
    // Where nothing is seen, or all is flat, the map still has a size.
    let least = DVec3::splat(all.max.distance(all.min).max(1e-6) * 1e-3);
    let middle = (min + max) * 0.5;
    let half = ((max - min) * 0.5).max(least);
    let depth = ((all.max - all.min) * 0.5).max(least);
    let depth_middle = (all.max.z + all.min.z) * 0.5;
    let (half, depth) = (half * MARGIN, depth.z * 1.01);
    // Near and far stand exchanged: depth is reversed. The view looks along -z.
    to_clip::orthographic(
        middle.x - half.x,
        middle.x + half.x,
        middle.y - half.y,
        middle.y + half.y,
        -depth_middle + depth,
        -depth_middle - depth,
    ) * view
}

/// A box along axes, the world's or those of a lamp's view.
struct Box3 {
    min: DVec3,
    max: DVec3,
}

impl Box3 {
    fn around(points: impl Iterator<Item = DVec3>) -> Self {
        let empty = Self {
            min: DVec3::INFINITY,
            max: DVec3::NEG_INFINITY,
        };
        points.fold(empty, |all, point| Self {
            min: all.min.min(point),
            max: all.max.max(point),
        })
    }
}

/// An opaque object: its draw, the corners of its mesh's box in the world, and the box of the world around them.
struct Caster {
    draw: Draw,
    corners: Vec<DVec3>,
    around: Box3,
}

fn casters(scene: &Scene, list: &DrawList) -> Vec<Caster> {
    let bounds: Vec<_> = scene.meshes.iter().map(Mesh::bounds).collect();
    let opaque = list.draws.iter().filter(|draw| {
        let object = &scene.objects[draw.instance as usize];
        scene.materials[object.material].opacity >= 1.0
    });
    opaque
        .map(|draw| {
            let object = &scene.objects[draw.instance as usize];
            let corners = bounds[object.mesh].corners();
            let corners = corners.map(|corner| object.transform.transform_point3(corner));
            let corners: Vec<_> = corners.map(|corner| corner.as_dvec3()).collect();
            Caster {
                draw: draw.clone(),
                around: Box3::around(corners.iter().copied()),
                corners,
            }
        })
        .collect()
}

/// The draws of what reaches into a map. `first` is the number of its first instance.
fn drawn(casters: &[Caster], clip: &DMat4, first: u32) -> Vec<Draw> {
    casters
        .iter()
        .filter(|caster| reaches_into(caster.corners.iter().map(|c| *clip * c.extend(1.0))))
        .map(|caster| Draw {
            instance: first + caster.draw.instance,
            ..caster.draw.clone()
        })
        .collect()
}

/// Whether a box with these corners, in clip space, may have a point inside: not all are beyond one side.
fn reaches_into(corners: impl Iterator<Item = DVec4>) -> bool {
    let sides: [fn(DVec4) -> bool; 5] = [
        |c| c.x < -c.w,
        |c| c.x > c.w,
        |c| c.y < -c.w,
        |c| c.y > c.w,
        // Nearer than near.
        |c| c.z > c.w,
    ];
    let mut beyond = [true; 5];
    for corner in corners {
        for (beyond, side) in beyond.iter_mut().zip(sides) {
            *beyond &= side(corner);
        }
    }
    !beyond.contains(&true)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn maps(count: usize) -> ShadowMaps {
        ShadowMaps {
            maps: vec![record(&DMat4::IDENTITY); count],
            of_light: Vec::new(),
            draws: Vec::new(),
        }
    }

    #[test]
    fn many_maps_are_smaller_so_that_all_fit() {
        let side = |count| maps(count).side();
        assert_eq!(
            [1, 16, 17, 64, 65, 256, 2000].map(side),
            [2048, 2048, 1024, 1024, 512, 512, 256]
        );
    }

    #[test]
    fn a_box_reaches_into_a_map_unless_it_is_wholly_beyond_one_side() {
        let clip = cone(Vec3::ZERO, DVec3::NEG_Z, 1.0, 0.1);
        let reaches = |x: f64, z: f64| {
            let corners =
                [-0.5, 0.5].map(|dx| [-0.5, 0.5].map(|dz| DVec3::new(x + dx, 0.0, z + dz)));
            reaches_into(corners.into_iter().flatten().map(|c| clip * c.extend(1.0)))
        };
        assert!(
            reaches(0.0, -5.0) && reaches(3.0, -5.0),
            "inside, and over the edge"
        );
        assert!(!reaches(4.0, -5.0) && !reaches(-4.0, -5.0), "beside");
        assert!(!reaches(0.0, 5.0), "behind");
        assert!(reaches(0.0, 0.0), "around the lamp");
    }

    #[test]
    fn a_plane_is_mapped_as_its_points_are() {
        let clip = cone(
            Vec3::new(1.0, 2.0, 3.0),
            DVec3::new(0.0, -0.6, 0.8),
            1.0,
            0.1,
        );
        let planes = record(&clip).planes;
        let planes = glam::Mat4::from_cols_array_2d(&planes).as_dmat4();
        // Through the point (1, 0, 5), with this normal.
        let (normal, point) = (DVec3::new(0.36, 0.48, 0.8), DVec3::new(1.0, 0.0, 5.0));
        let plane = planes * normal.extend(-normal.dot(point));
        let along = normal.any_orthonormal_vector();
        for step in [-1.0, 0.0, 2.0] {
            let on_it = clip * (point + along * step).extend(1.0);
            assert!(plane.dot(on_it).abs() < 1e-4, "{step}");
        }
        assert!(plane.dot(clip * (point + normal).extend(1.0)).abs() > 0.1);
    }
}
