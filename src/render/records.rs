//! How does a scene become the records that the shaders read?

use glam::{Affine3A, DVec3, Vec3};

use super::maps::Maps;
use crate::interface::reflected::values;
use crate::interface::{Instance, Light, Material};
use crate::reference::ladders::Fresnel;
use crate::reference::metal::Metal;
use crate::reference::reflectance::Reflectance;
use crate::scene::{self, Slot};

/// The record of a material that calls for the effects of these bits.
pub fn material(
    material: &scene::Material,
    effects: u32,
    fresnel: Fresnel,
    maps: &Maps,
) -> Material {
    let map = |slot| maps.handle(material.maps.get(slot));
    let (f0, [fresnel_1, fresnel_2, fresnel_3, fresnel_4]) = reflectance(material, fresnel);
    Material {
        albedo: material.albedo,
        opacity: material.opacity,
        f0,
        fresnel_1,
        fresnel_2,
        fresnel_3,
        fresnel_4,
        roughness: material.roughness,
        emission: material.emission,
        shininess: material.shininess,
        effects,
        metalness: material.metalness,
        normal_scale: material.normal_scale,
        alpha_cutoff: material.alpha_cutoff,
        map_repeat: material.maps.repeat,
        base_color_map: map(Slot::BaseColor),
        emission_map: map(Slot::Emission),
        normal_map: map(Slot::Normal),
        roughness_map: map(Slot::Roughness),
        metalness_map: map(Slot::Metalness),
        occlusion_map: map(Slot::Occlusion),
        alpha_mask: map(Slot::AlphaMask),
        ..bytemuck::Zeroable::zeroed()
    }
}

/// What the shaders' Fresnel term takes: f0, and what `interface/materials.glsl` says of the other four.
fn reflectance(material: &scene::Material, tier: Fresnel) -> ([f32; 3], [[f32; 3]; 4]) {
    let f0 = Vec3::from(material.f0).as_dvec3();
    let metal = material.metal.unwrap_or_else(|| Metal::clear(f0));
    let mean = || Reflectance { tier, f0, metal }.mean();
    let zero = DVec3::ZERO;
    let (f0, numbers) = match tier {
        Fresnel::Scale | Fresnel::Schlick => (f0, [zero; 4]),
        Fresnel::F82 => (f0, [metal.tint, zero, zero, zero]),
        Fresnel::Dielectric => (f0, [mean(), zero, zero, zero]),
        Fresnel::Conductor => (f0, [metal.n, metal.k, mean(), zero]),
        Fresnel::Spectral => (metal.f0, metal.coefficients),
    };
    let narrow = |v: DVec3| v.as_vec3().to_array();
    (narrow(f0), numbers.map(narrow))
}

/// The record of an object that stands at `transform` and is made of material number `material`.
pub fn instance(transform: &Affine3A, material: u32) -> Instance {
    let [x, y, z] = transform.matrix3.transpose().to_cols_array_2d();
    let [tx, ty, tz] = transform.translation.to_array();
    Instance {
        world_x: [x[0], x[1], x[2], tx],
        world_y: [y[0], y[1], y[2], ty],
        world_z: [z[0], z[1], z[2], tz],
        material,
        handedness: transform.matrix3.determinant().signum(),
        instance_padding_0: 0,
        instance_padding_1: 0,
    }
}

/// The record of a light that calls for the effects of these bits, with its shadow maps: the first, and how
/// many.
pub fn light(
    light: &scene::Light,
    effects: u32,
    (shadow_first, shadow_count): (u32, u32),
) -> Light {
    let strength = |strength: f32| light.color.map(|channel| channel * strength);
    // A lamp that may not stand somewhere shines from there all the same, as if from far away.
    let place = |position: Vec3| match effects & values::BIT_POINT_LIGHT {
        0 => position.normalize_or(Vec3::Y).extend(0.0),
        _ => position.extend(1.0),
    };
    let record = Light {
        effects,
        shadow_first,
        shadow_count,
        ..bytemuck::Zeroable::zeroed()
    };
    match light.kind {
        scene::LightKind::Directional {
            direction,
            illuminance,
            angular_diameter_degrees,
        } => Light {
            position: (-direction).extend(0.0).to_array(),
            intensity: strength(illuminance),
            radius: (angular_diameter_degrees * 0.5).to_radians().tan(),
            ..record
        },
        scene::LightKind::Point {
            position,
            intensity,
            radius,
        } => Light {
            position: place(position).to_array(),
            intensity: strength(intensity),
            radius,
            ..record
        },
        scene::LightKind::Spot {
            position,
            direction,
            intensity,
            radius,
            inner_degrees,
            outer_degrees,
        } => {
            let (cone_scale, cone_offset) = cone(inner_degrees, outer_degrees);
            Light {
                position: place(position).to_array(),
                intensity: strength(intensity),
                radius,
                axis: direction.to_array(),
                cone_scale,
                cone_offset,
                ..record
            }
        }
    }
}

/// Scale and offset that map the cosine at the outer angle to 0 and that at the inner to 1.
fn cone(inner_degrees: f32, outer_degrees: f32) -> (f32, f32) {
    let cos = |degrees: f32| f64::from(degrees).to_radians().cos();
    let outer = cos(outer_degrees);
    // The loader refuses an edge whose cosines differ by less than 1e-6, so this is no division by 0.
    let width = cos(inner_degrees) - outer;
    ((1.0 / width) as f32, (-outer / width) as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cone_is_0_at_its_edge_and_1_at_its_core() {
        for (inner, outer) in [(10.0, 20.0), (0.0, 45.0), (80.0, 89.0)] {
            let (scale, offset) = cone(inner, outer);
            let at = |degrees: f32| degrees.to_radians().cos() * scale + offset;
            assert!((at(inner) - 1.0).abs() < 1e-4, "{inner}: {}", at(inner));
            assert!(at(outer).abs() < 1e-4, "{outer}: {}", at(outer));
        }
    }

    #[test]
    fn the_rows_of_an_instance_map_points_as_the_transform_does() {
        let transform = Affine3A::from_scale_rotation_translation(
            Vec3::new(2.0, -3.0, 0.5),
            glam::Quat::from_rotation_z(0.7),
            Vec3::new(1.0, 2.0, 3.0),
        );
        let record = instance(&transform, 5);
        let point = Vec3::new(0.3, -0.2, 0.9);
        let rows = [record.world_x, record.world_y, record.world_z];
        let mapped = rows.map(|row| glam::Vec4::from_array(row).dot(point.extend(1.0)));
        let expected = transform.transform_point3(point);
        assert!((Vec3::from_array(mapped) - expected).length() < 1e-6);
        assert_eq!((record.handedness, record.material), (-1.0, 5));
    }
}
