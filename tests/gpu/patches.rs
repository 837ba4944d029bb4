//! How does one frame hold a thousand cases whose colour is known beforehand?
//!
//! A grid of flat patches faces an orthographic camera. Each patch has a normal and a material of its
//! own; all share the direction to the eye and the lights. The pixel in a patch's middle is compared
//! with the f64 reference, fed with the same f32 numbers.

use glam::{Affine3A, DVec3, Vec3};
use umber::reference::hemisphere::Surroundings;
use umber::reference::shade::{self, Surface};
use umber::render::{Picture, Variant};
use umber::scene::{Ambient, Camera, Light, LightKind, Material, Mesh, Object, Projection, Scene};
use umber::studies::cost::reference_light;

use crate::harness::{Gpu, with_gpu};
use crate::tolerances;

/// Pixels along a patch's side; the one compared is in its middle.
const SIDE: u32 = 3;

/// One case.
#[derive(Clone, Debug)]
pub struct Patch {
    /// The shading normal, of any length.
    pub normal: Vec3,
    pub material: Material,
}

/// Cases that share eye, lights and surroundings.
pub struct Patches {
    /// Direction to the eye.
    pub to_eye: Vec3,
    pub lights: Vec<Light>,
    pub ambient: Ambient,
    pub patches: Vec<Patch>,
}

/// A material of these numbers, opaque and dark.
pub fn material(albedo: [f32; 3], f0: [f32; 3], roughness: f32) -> Material {
    Material {
        name: "case".into(),
        albedo,
        f0,
        roughness,
        shininess: umber::scene::shininess_from_roughness(f64::from(roughness)) as f32,
        ..Material::default()
    }
}

/// A light so far that only its direction counts, of `color` lx.
pub fn towards(direction: Vec3, color: [f32; 3]) -> Light {
    Light {
        name: "case".into(),
        color,
        shadow: false,
        kind: LightKind::Directional {
            direction: -direction,
            illuminance: 1.0,
            angular_diameter_degrees: 0.53,
        },
    }
}

/// No light from around.
pub const DARK: Ambient = Ambient {
    sky: [0.0; 3],
    ground: [0.0; 3],
};

impl Patches {
    fn columns(&self) -> u32 {
        (self.patches.len() as f64).sqrt().ceil() as u32
    }

    fn rows(&self) -> u32 {
        (self.patches.len() as u32).div_ceil(self.columns())
    }

    /// The picture's size, pixels.
    pub fn size(&self) -> (u32, u32) {
        (self.columns() * SIDE, self.rows() * SIDE)
    }

    /// Right and up in the picture.
    fn axes(&self) -> (Vec3, Vec3) {
        let forward = -self.to_eye.normalize();
        let up = forward.any_orthonormal_vector();
        let right = forward.cross(up).normalize();
        (right, right.cross(forward))
    }

    fn camera(&self) -> Camera {
        Camera {
            position: self.to_eye.normalize() * 10.0,
            target: Vec3::ZERO,
            up: self.axes().1,
            projection: Projection::Orthographic {
                height: self.rows() as f32,
            },
            exposure_ev100: 0.0,
        }
    }

    /// The middle of patch `i`, m; patches are 1 m wide.
    pub fn middle(&self, i: usize) -> Vec3 {
        let (right, up) = self.axes();
        let (column, row) = (i as u32 % self.columns(), i as u32 / self.columns());
        let x = column as f32 + 0.5 - self.columns() as f32 / 2.0;
        let y = self.rows() as f32 / 2.0 - row as f32 - 0.5;
        right * x + up * y
    }

    /// The scene of the patches.
    pub fn scene(&self) -> Scene {
        let (right, up) = self.axes();
        let corners = [-right - up, right - up, right + up, up - right].map(|c| c * 0.5);
        let mesh = |patch: &Patch| Mesh {
            name: "patch".into(),
            positions: corners.map(|corner| corner.to_array()).to_vec(),
            normals: vec![patch.normal.to_array(); 4],
            indices: vec![0, 1, 2, 0, 2, 3],
            ..Mesh::default()
        };
        let object = |i| Object {
            name: format!("patch {i}"),
            mesh: i,
            material: i,
            transform: Affine3A::from_translation(self.middle(i)),
        };
        Scene {
            camera: self.camera(),
            ambient: self.ambient,
            lights: self.lights.clone(),
            materials: self.patches.iter().map(|p| p.material.clone()).collect(),
            meshes: self.patches.iter().map(mesh).collect(),
            objects: (0..self.patches.len()).map(object).collect(),
            textures: Vec::new(),
            warnings: Vec::new(),
        }
    }

    /// What the device makes of each patch.
    pub fn rendered(&self, gpu: &Gpu, variant: Variant) -> Vec<[f32; 4]> {
        let picture = gpu.render(&self.scene(), self.size(), variant);
        (0..self.patches.len())
            .map(|i| self.pixel(&picture, i))
            .collect()
    }

    fn pixel(&self, picture: &Picture, i: usize) -> [f32; 4] {
        let (column, row) = (i as u32 % self.columns(), i as u32 / self.columns());
        picture.at(column * SIDE + SIDE / 2, row * SIDE + SIDE / 2)
    }

    /// What the reference says of patch `i`.
    pub fn predicted(&self, i: usize, variant: Variant) -> [f64; 4] {
        let patch = &self.patches[i];
        let camera = self.camera();
        let to_eye = -(camera.target - camera.position).normalize();
        let surface = surface(&patch.material, self.middle(i), patch.normal, to_eye);
        let lights: Vec<_> = self.lights.iter().map(reference_light).collect();
        let around = surroundings(&self.ambient);
        let ([r, g, b], alpha) =
            shade::shade(&surface, &lights, &around, variant.lighting, variant.terms);
        [r, g, b, alpha]
    }
}

/// Every pixel against its prediction; a failure prints what repeats it.
pub fn assert_predicted(patches: &Patches, variant: Variant, tolerance: tolerances::Relative) {
    let rendered = with_gpu(|gpu| patches.rendered(gpu, variant));
    let (mut compared, mut worst) = (0, 0.0_f64);
    for (i, got) in rendered.into_iter().enumerate() {
        let want = patches.predicted(i, variant);
        if !want.iter().all(|value| value.is_finite()) {
            continue;
        }
        compared += 1;
        for (got, want) in got.into_iter().zip(want) {
            let share = tolerance.share(f64::from(got), want);
            worst = worst.max(share);
            assert!(
                share <= 1.0,
                "{variant}: {got:e} for {want:e}\nto_eye {:?}\n{:?}\nlights {:?}",
                patches.to_eye,
                patches.patches[i],
                patches.lights
            );
        }
    }
    println!("{variant}: the worst pixel takes {worst:.3} of the tolerance");
    assert!(
        compared * 2 >= patches.patches.len(),
        "{compared} cases are defined"
    );
}

/// A point of a surface, widened to f64.
pub fn surface(material: &Material, position: Vec3, normal: Vec3, to_eye: Vec3) -> Surface {
    Surface {
        position: position.as_dvec3(),
        normal: normal.as_dvec3(),
        to_eye: to_eye.as_dvec3(),
        albedo: wide(material.albedo),
        opacity: f64::from(material.opacity),
        f0: wide(material.f0),
        metal: material.metal,
        roughness: f64::from(material.roughness),
        emission: wide(material.emission),
        shininess: f64::from(material.shininess),
    }
}

/// The surroundings, widened to f64.
pub fn surroundings(ambient: &Ambient) -> Surroundings {
    Surroundings {
        sky: wide(ambient.sky),
        ground: wide(ambient.ground),
    }
}

fn wide(color: [f32; 3]) -> DVec3 {
    DVec3::from_array(color.map(f64::from))
}
