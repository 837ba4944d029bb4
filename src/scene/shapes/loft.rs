//! How do outlines become solids: turned, swept, extruded, boxed?

use std::f32::consts::TAU;

use glam::{Affine3A, Quat, Vec2, Vec3};

use super::surface::Solid;

/// What closes the two ends of a loft.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Ends {
    /// Each end is closed by a fan around its centre.
    Capped,
    /// The last loop joins the first.
    Joined,
}

/// Skins loops of equally many points, each counter-clockwise seen from the next one.
pub fn loft(loops: &[Vec<Vec3>], ends: Ends) -> Solid {
    let mut solid = Solid::default();
    let Some(count) = loops.first().map(Vec::len) else {
        return solid;
    };
    solid.points = loops.concat();
    let rows = if ends == Ends::Joined {
        loops.len()
    } else {
        loops.len() - 1
    };
    for row in 0..rows {
        let (low, high) = (row * count, (row + 1) % loops.len() * count);
        for j in 0..count {
            let k = (j + 1) % count;
            let [a, b, c, d] = [low + j, low + k, high + k, high + j].map(|index| index as u32);
            solid.quad(a, b, c, d);
        }
    }
    if ends == Ends::Capped {
        cap(&mut solid, 0, count, true);
        cap(&mut solid, (loops.len() - 1) * count, count, false);
    }
    solid
}

fn cap(solid: &mut Solid, first: usize, count: usize, bottom: bool) {
    let sum: Vec3 = solid.points[first..first + count].iter().sum();
    let centre = solid.point(sum / count as f32);
    for j in 0..count {
        let (a, b) = ((first + j) as u32, (first + (j + 1) % count) as u32);
        solid.faces.push(if bottom {
            [centre, b, a]
        } else {
            [centre, a, b]
        });
    }
}

/// A loop around +y at `height`: `radius` of each angle, counter-clockwise from above.
pub fn ring(count: usize, height: f32, radius: impl Fn(f32) -> f32) -> Vec<Vec3> {
    let point = |j: usize| {
        let angle = TAU * j as f32 / count as f32;
        let r = radius(angle);
        Vec3::new(r * angle.cos(), height, -r * angle.sin())
    };
    (0..count).map(point).collect()
}

/// Turns a profile of (radius, height) around +y; its outside lies to the right of its course.
/// A profile that ends off the axis is closed by a flat cap.
pub fn lathe(profile: &[Vec2], segments: usize) -> Solid {
    // A point on the axis is left to the cap, whose centre it is.
    let off_axis = profile.iter().filter(|p| p.x > 1e-6);
    let loops: Vec<_> = off_axis.map(|p| ring(segments, p.y, |_| p.x)).collect();
    let mut solid = loft(&loops, Ends::Capped);
    let centres = solid.points.len() - 2;
    for (at, end) in [(centres, profile.first()), (centres + 1, profile.last())] {
        if let Some(end) = end {
            solid.points[at] = Vec3::new(0.0, end.y, 0.0);
        }
    }
    solid
}

/// A smooth curve through all points (E. Catmull and R. Rom, 1974; its ends are straight),
/// `steps` pieces per span, both ends included.
pub fn curve3(points: &[Vec3], steps: usize) -> Vec<Vec3> {
    let at = |i: isize| points[i.clamp(0, points.len() as isize - 1) as usize];
    let mut out = Vec::with_capacity(points.len() * steps + 1);
    for span in 0..points.len() as isize - 1 {
        let (a, b, c, d) = (at(span - 1), at(span), at(span + 1), at(span + 2));
        for step in 0..steps {
            let t = step as f32 / steps as f32;
            let linear = (c - a) * t;
            let square = (a * 2.0 - b * 5.0 + c * 4.0 - d) * (t * t);
            let cube = (b * 3.0 - a - c * 3.0 + d) * (t * t * t);
            out.push(b + (linear + square + cube) * 0.5);
        }
    }
    out.extend(points.last());
    out
}

/// `curve3` for profiles; radii stay at or above 0.
pub fn curve2(points: &[[f32; 2]], steps: usize) -> Vec<Vec2> {
    let lifted: Vec<Vec3> = points.iter().map(|p| Vec3::new(p[0], p[1], 0.0)).collect();
    let clamp = |p: Vec3| Vec2::new(p.x.max(0.0), p.y);
    curve3(&lifted, steps).into_iter().map(clamp).collect()
}

/// A tube along `path`; `section` gives the half-widths (across, upward) at 0..1 of its points.
/// The frame is carried along without twist; both ends are capped.
pub fn sweep(path: &[Vec3], sides: usize, section: impl Fn(f32) -> Vec2) -> Solid {
    let last = path.len() - 1;
    let tangent = |i: usize| (path[(i + 1).min(last)] - path[i.saturating_sub(1)]).normalize();
    let mut across = tangent(0).any_orthonormal_vector();
    let mut loops = Vec::with_capacity(path.len());
    for (i, centre) in path.iter().enumerate() {
        let forward = tangent(i);
        if i > 0 {
            across = Quat::from_rotation_arc(tangent(i - 1), forward) * across;
        }
        across = across.reject_from(forward).normalize();
        let up = forward.cross(across);
        let half = section(i as f32 / last as f32);
        let point = |j: usize| {
            let angle = TAU * j as f32 / sides as f32;
            *centre + across * (half.x * angle.cos()) + up * (half.y * angle.sin())
        };
        loops.push((0..sides).map(point).collect());
    }
    loft(&loops, Ends::Capped)
}

/// The outline of a rectangle with round corners, counter-clockwise from +y.
pub fn rounded_rectangle(half: Vec2, radius: f32, steps: usize, height: f32) -> Vec<Vec3> {
    let corner = |quarter: usize| {
        let (x, z) = [(1.0, 1.0), (1.0, -1.0), (-1.0, -1.0), (-1.0, 1.0)][quarter];
        let centre = Vec3::new(x * (half.x - radius), height, z * (half.y - radius));
        (0..=steps).map(move |step| {
            let angle = TAU / 4.0 * (quarter as f32 - 1.0 + step as f32 / steps as f32);
            centre + Vec3::new(angle.cos(), 0.0, -angle.sin()) * radius
        })
    };
    (0..4).flat_map(corner).collect()
}

/// A box centred at the origin, all edges rounded by `bevel` in `steps` pieces.
pub fn rounded_box(half: Vec3, bevel: f32, steps: usize) -> Solid {
    let mut loops = Vec::new();
    for (sign, order) in [(-1.0, 0), (1.0, steps)] {
        for step in 0..=steps {
            let angle = TAU / 4.0 * order.abs_diff(step) as f32 / steps as f32;
            let (inset, height) = (
                bevel * (1.0 - angle.sin()),
                half.y - bevel * (1.0 - angle.cos()),
            );
            let flat = Vec2::new(half.x - inset, half.z - inset);
            // A hair of corner radius stays, so that every loop has distinct points.
            let radius = (bevel - inset).max(bevel * 0.05);
            loops.push(rounded_rectangle(flat, radius, steps, sign * height));
        }
    }
    loft(&loops, Ends::Capped)
}

/// A move by (x, y, z).
pub fn at(x: f32, y: f32, z: f32) -> Affine3A {
    Affine3A::from_translation(Vec3::new(x, y, z))
}

/// A turn about +y, degrees, then a move.
pub fn turned_at(degrees: f32, place: Vec3) -> Affine3A {
    Affine3A::from_rotation_translation(Quat::from_rotation_y(degrees.to_radians()), place)
}
