//! What says glass without a word? A stemmed goblet with wine in it, and a carafe.

use glam::{Vec2, Vec3};

use super::loft::{at, curve2, lathe};
use super::surface::Surface;
use super::{Part, part};

/// The goblet's outside from the foot's rim to the lip: (radius, height).
const OUTSIDE: [[f32; 2]; 13] = [
    [0.268, 0.012],
    [0.20, 0.026],
    [0.09, 0.045],
    [0.036, 0.085],
    [0.025, 0.15],
    [0.024, 0.27],
    [0.030, 0.36],
    [0.065, 0.42],
    [0.170, 0.48],
    [0.265, 0.575],
    [0.305, 0.69],
    [0.292, 0.83],
    [0.240, 1.0],
];

/// Its inside, from the lip to the bottom: the wall is 12 mm thick.
const INSIDE: [[f32; 2]; 8] = [
    [0.228, 1.0],
    [0.280, 0.83],
    [0.293, 0.69],
    [0.253, 0.582],
    [0.158, 0.493],
    [0.095, 0.461],
    [0.045, 0.449],
    [0.0, 0.446],
];

/// The carafe's outside: a wide belly, a narrow neck, a flared lip.
const CARAFE: [[f32; 2]; 9] = [
    [0.215, 0.012],
    [0.262, 0.07],
    [0.285, 0.17],
    [0.255, 0.31],
    [0.150, 0.45],
    [0.082, 0.57],
    [0.070, 0.70],
    [0.085, 0.79],
    [0.135, 0.87],
];

/// Wall thickness of the carafe.
const WALL: f32 = 0.012;

fn goblet_wall() -> Surface {
    let mut profile = vec![Vec2::ZERO, Vec2::new(0.262, 0.0), Vec2::new(0.269, 0.005)];
    profile.extend(curve2(&OUTSIDE, 4));
    profile.extend([Vec2::new(0.237, 1.006), Vec2::new(0.231, 1.006)]);
    profile.extend(curve2(&INSIDE, 4));
    lathe(&profile, 56).shade(60.0)
}

/// Fills the goblet to `level`; 3 mm of air lie between wine and wall, so that the two never
/// share a depth.
fn wine(level: f32) -> Surface {
    let mut profile: Vec<Vec2> = curve2(&INSIDE, 4)
        .into_iter()
        .rev()
        .map(|p| Vec2::new((p.x - 0.003).max(0.0), p.y + 0.003))
        .take_while(|p| p.y < level)
        .collect();
    let edge = profile.last().map_or(0.0, |p| p.x);
    profile.extend([Vec2::new(edge, level), Vec2::new(0.0, level)]);
    lathe(&profile, 56).shade(40.0)
}

fn carafe() -> Surface {
    let outside = curve2(&CARAFE, 5);
    let mut profile = vec![Vec2::ZERO, Vec2::new(0.205, 0.0)];
    profile.extend(&outside);
    // The inside follows the outside, one wall inward across the curve.
    let last = outside.len() - 1;
    let inner = |i: usize| {
        let along = (outside[(i + 1).min(last)] - outside[i.saturating_sub(1)]).normalize();
        outside[i] - Vec2::new(along.y, -along.x) * WALL
    };
    profile.extend((0..=last).rev().map(inner).filter(|p| p.y > 0.03));
    profile.push(Vec2::new(0.0, 0.03));
    lathe(&profile, 52).shade(60.0)
}

pub fn goblet() -> Vec<Part> {
    let front = at(0.16, 0.0, 0.14);
    let mut glass = Surface::default();
    glass.append(
        &carafe(),
        glam::Affine3A::from_translation(Vec3::new(-0.2, 0.0, -0.14)),
    );
    glass.append(
        &goblet_wall().placed(glam::Affine3A::from_scale(Vec3::splat(0.92))),
        front,
    );
    let wine = wine(0.70).placed(front * glam::Affine3A::from_scale(Vec3::splat(0.92)));
    vec![part("glass", glass), part("wine", wine)]
}
