//! What says skin without a word? A relaxed right hand, seen from its back.
//!
//! The proportions follow a hand of 19 cm, drawn 3.7 times as large.

use glam::{Affine3A, Quat, Vec3};

use super::sdf::{Roll, add, ball, carve, ellipsoid, join, limb, roll};
use super::surface::Surface;
use super::{Part, part, surface_nets};

/// Knuckle (x, y, z), length, spread and curl in degrees, thickness at the knuckle.
struct Digit {
    knuckle: Vec3,
    length: f32,
    spread: f32,
    curl: f32,
    girth: f32,
}

const FINGERS: [Digit; 4] = [
    Digit {
        knuckle: Vec3::new(-0.112, 0.535, 0.000),
        length: 0.365,
        spread: -7.0,
        curl: 6.0,
        girth: 0.045,
    },
    Digit {
        knuckle: Vec3::new(-0.034, 0.550, 0.010),
        length: 0.405,
        spread: -1.0,
        curl: 10.0,
        girth: 0.046,
    },
    Digit {
        knuckle: Vec3::new(0.043, 0.535, 0.004),
        length: 0.378,
        spread: 5.0,
        curl: 15.0,
        girth: 0.043,
    },
    Digit {
        knuckle: Vec3::new(0.112, 0.500, -0.012),
        length: 0.300,
        spread: 13.0,
        curl: 20.0,
        girth: 0.037,
    },
];

/// A digit's bones as joints from the knuckle to the tip, with the flesh's radius at each,
/// and the direction in which the back of the last bone faces.
struct Bones {
    joints: [Vec3; 4],
    radii: [f32; 4],
    back: Vec3,
}

impl Digit {
    fn bones(&self) -> Bones {
        // Share of the three bones in a finger's length (anatomy: about 45 : 30 : 25).
        let shares = [0.45, 0.30, 0.25];
        // The middle joint bends most, the last about half of it.
        let bends = [1.0, 1.7, 1.0];
        let spread = Quat::from_rotation_z(-self.spread.to_radians());
        let mut joints = [self.knuckle; 4];
        let mut bend = 0.0;
        for bone in 0..3 {
            bend += self.curl * bends[bone];
            let along = spread * Quat::from_rotation_x(-bend.to_radians()) * Vec3::Y;
            // The tip's flesh reaches past the bone: the last joint stops a radius short.
            let shorten = if bone == 2 { self.girth * 0.62 } else { 0.0 };
            joints[bone + 1] = joints[bone] + along * (self.length * shares[bone] - shorten);
        }
        let back = spread * Quat::from_rotation_x(-bend.to_radians()) * Vec3::Z;
        let g = self.girth;
        Bones {
            joints,
            radii: [g, g * 0.86, g * 0.76, g * 0.64],
            back,
        }
    }
}

const THUMB: Bones = Bones {
    joints: [
        Vec3::new(-0.065, 0.285, -0.015),
        Vec3::new(-0.178, 0.425, -0.030),
        Vec3::new(-0.238, 0.545, -0.034),
        Vec3::new(-0.268, 0.635, -0.030),
    ],
    radii: [0.060, 0.049, 0.043, 0.035],
    back: Vec3::new(-0.50, -0.14, 0.855),
};

impl Bones {
    /// Flesh around the bones, thicker at the joints, with creases over the middle joint.
    fn flesh(&self, p: Vec3) -> f32 {
        let (j, r) = (&self.joints, &self.radii);
        // Far away a ball around the whole digit is bound enough.
        let middle = (j[0] + j[3]) * 0.5;
        let bound = p.distance(middle) - (j[0].distance(j[3]) * 0.5 + r[0] * 1.4);
        if bound > FAR {
            return bound;
        }
        let mut d = limb(p, j[0], j[1], r[0], r[1] * 0.97);
        // A blend of two equal distances bulges by a quarter of its width: 2 mm at each joint.
        d = join(d, limb(p, j[1], j[2], r[1] * 0.97, r[2]), 0.008);
        d = join(d, limb(p, j[2], j[3], r[2], r[3]), 0.008);
        for k in [1, 2] {
            d = join(
                d,
                ball(p, j[k] + self.back * (r[k] * 0.14), r[k] * 0.90),
                0.010,
            );
        }
        // The fingertip's pad, on the palm's side.
        let pad = j[3].lerp(j[2], 0.25) - self.back * (r[3] * 0.22);
        d = join(d, ball(p, pad, r[3] * 0.92), 0.012);
        d + self.creases(p, 1, 0.0012) + self.creases(p, 2, 0.0008)
    }

    /// Folds of skin across the back of joint `k`, `depth` metres deep.
    fn creases(&self, p: Vec3, k: usize, depth: f32) -> f32 {
        let along = (self.joints[k + 1] - self.joints[k - 1]).normalize();
        let from = p - self.joints[k];
        let (t, height) = (
            from.dot(along) / self.radii[k],
            from.dot(self.back) / self.radii[k],
        );
        let window = (1.0 - t * t * 2.2).max(0.0) * ((height - 0.1) * 1.4).clamp(0.0, 1.0);
        if window == 0.0 {
            return 0.0;
        }
        // Five folds over the joint.
        depth * window * (t * 16.0).cos()
    }

    /// The nail's field: negative where the plate lies, on the back of the last bone.
    fn nail(&self, p: Vec3) -> f32 {
        let tip = self.joints[3];
        let along = (tip - self.joints[2]).normalize();
        let across = along.cross(self.back);
        let r = self.radii[3];
        let from = p - (tip + self.back * r * 0.95 + along * r * 0.10);
        let local = Vec3::new(from.dot(across), from.dot(along), from.dot(self.back));
        ellipsoid(local, Vec3::ZERO, Vec3::new(r * 0.80, r * 1.16, r * 0.62))
    }
}

/// The two bones of the forearm; their blend is flat between them, as a wrist is.
const FOREARM: [Roll; 2] = [
    [-0.052, -0.12, 0.0, -0.046, 0.26, 0.0, 0.080, 0.062, 0.09],
    [0.056, -0.12, 0.0, 0.050, 0.26, 0.0, 0.076, 0.058, 0.09],
];
/// The heel of the hand, the ball of the thumb, and the web between thumb and index.
const CUSHIONS: [Roll; 3] = [
    [0.075, 0.27, -0.03, 0.110, 0.43, -0.03, 0.050, 0.042, 0.05],
    [-0.06, 0.30, -0.04, -0.13, 0.41, -0.04, 0.055, 0.044, 0.05],
    [-0.09, 0.36, -0.02, -0.125, 0.45, -0.015, 0.045, 0.025, 0.06],
];

fn palm(p: Vec3) -> f32 {
    let arm = add(p, roll(p, &FOREARM[0]), &FOREARM[1..]);
    // The ulna's head.
    let mut d = join(arm, ball(p, Vec3::new(0.078, 0.175, 0.028), 0.026), 0.06);
    for (n, finger) in FINGERS.iter().enumerate() {
        let start = Vec3::new(-0.050 + 0.034 * n as f32, 0.26, 0.0);
        let knuckle = finger.knuckle - Vec3::Z * 0.012;
        let bone = limb(p, start, knuckle, 0.052, finger.girth * 1.06);
        d = join(d, bone, 0.045);
    }
    add(p, d, &CUSHIONS)
}

/// Tendons that fan from the wrist to the knuckles, and the knuckles themselves.
fn back_of_hand(p: Vec3, skin: f32) -> f32 {
    let mut d = skin;
    for finger in &FINGERS {
        let k = finger.knuckle;
        let top = k + Vec3::new(0.0, 0.0, finger.girth * 0.50);
        d = join(d, ball(p, top, finger.girth * 0.56), 0.040);
        let start = Vec3::new(k.x * 0.35, 0.30, 0.036);
        d = join(
            d,
            limb(p, start, top + Vec3::new(0.0, -0.02, 0.007), 0.006, 0.010),
            0.040,
        );
    }
    d
}

/// Beyond this distance, m, a bound serves as well as the form: no blend reaches so far, and the
/// mesher skips what is further than 4 cells of 10 mm.
const FAR: f32 = 0.045;

struct Hand {
    fingers: [Bones; 4],
}

impl Hand {
    /// Skin without the nails' beds.
    fn skin(&self, p: Vec3) -> f32 {
        // The knuckles end below 0.61 m.
        let above = p.y - 0.61;
        let body = if above > FAR {
            above
        } else {
            back_of_hand(p, palm(p))
        };
        // Fingers melt into the palm, and hardly into one another.
        let fingers = self
            .fingers
            .iter()
            .map(|bones| bones.flesh(p))
            .reduce(|a, b| join(a, b, 0.010));
        let d = join(body, fingers.unwrap_or(f32::MAX), 0.032);
        join(d, THUMB.flesh(p), 0.045)
    }

    fn nails(&self, p: Vec3) -> f32 {
        let fingers = self.fingers.iter().map(|bones| bones.nail(p));
        fingers.fold(THUMB.nail(p), f32::min)
    }

    /// Everything above the cut at y = 0, a fold around each nail.
    fn solid(&self, p: Vec3) -> f32 {
        let d = self.skin(p);
        if d.abs() > 0.02 {
            return d.max(-p.y);
        }
        // A fold 3 mm deep runs along each nail's edge.
        let fold = (self.nails(p).abs() - 0.0045).max(-d - 0.003);
        carve(carve(d, fold, 0.004), p.y, 0.02)
    }
}

pub fn hand() -> Vec<Part> {
    let hand = Hand {
        fingers: FINGERS.map(|finger| finger.bones()),
    };
    let (low, high) = (Vec3::new(-0.34, -0.03, -0.26), Vec3::new(0.24, 1.0, 0.12));
    let skin = surface_nets::mesh([low, high], 0.0100, |p| p, |p| hand.solid(p));
    let [skin, nails] = skin.split(|p| hand.nails(p) + 0.001);
    let place = Affine3A::from_translation(Vec3::new(0.0, 0.0, 0.05));
    let mut placed = Surface::default();
    placed.append(&skin, place);
    vec![part("skin", placed), part("nails", nails.placed(place))]
}
