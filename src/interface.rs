//! What do host and shader share, and who makes sure that they agree?
//!
//! The compiler does: each struct is compared with what naga read in the GLSL source, field by
//! field, and binding numbers, locations and constants are the shader's own.

use bytemuck::{Pod, Zeroable};

mod agree;

use agree::agree;

include!(concat!(env!("OUT_DIR"), "/shaders.rs"));

/// One frame; see `shaders-glsl/interface/frame.glsl` for units.
#[derive(Clone, Copy, Pod, Zeroable, Debug)]
#[repr(C)]
pub struct Frame {
    /// World to clip space, column by column; reversed depth.
    pub view_projection: [[f32; 4]; 4],
    /// The eye, homogeneous.
    pub eye: [f32; 4],
    /// Radiance of the upper hemisphere.
    pub sky: [f32; 3],
    /// Lights in use.
    pub light_count: u32,
    /// Radiance of the lower hemisphere.
    pub ground: [f32; 3],
    /// Objects in use.
    pub object_count: u32,
}
agree!(Frame {
    view_projection,
    eye,
    sky,
    light_count,
    ground,
    object_count
});

/// One drawn object; see `shaders-glsl/interface/instances.glsl`.
#[derive(Clone, Copy, Pod, Zeroable, Debug)]
#[repr(C)]
pub struct Instance {
    /// First row of object-to-world.
    pub world_x: [f32; 4],
    /// Second row.
    pub world_y: [f32; 4],
    /// Third row.
    pub world_z: [f32; 4],
    /// Index of its material.
    pub material: u32,
    /// -1 where the map mirrors, else 1.
    pub handedness: f32,
    /// Unused.
    pub instance_padding_0: u32,
    /// Unused.
    pub instance_padding_1: u32,
}
agree!(Instance {
    world_x,
    world_y,
    world_z,
    material,
    handedness,
    instance_padding_0,
    instance_padding_1
});

// lavapipe's storage range is 128 MiB: with 128 bytes a record, a million objects fit.
const _: () = assert!(size_of::<Instance>() <= 128);

/// One material; see `shaders-glsl/interface/materials.glsl`.
#[derive(Clone, Copy, Pod, Zeroable, Debug, PartialEq)]
#[repr(C)]
pub struct Material {
    /// Diffuse reflectance.
    pub albedo: [f32; 3],
    /// How much it hides what lies behind.
    pub opacity: f32,
    /// Specular reflectance at normal incidence.
    pub f0: [f32; 3],
    /// Oren-Nayar's sigma and Beckmann's m.
    pub roughness: f32,
    /// Radiance given off.
    pub emission: [f32; 3],
    /// Phong's exponent.
    pub shininess: f32,
    /// Bits of the effects that it calls for.
    pub effects: u32,
    /// Factor of the metalness map.
    pub metalness: f32,
    /// Factor of the normal map's x and y.
    pub normal_scale: f32,
    /// Below it the alpha mask leaves no surface.
    pub alpha_cutoff: f32,
    /// Repeats of the maps per unit of the coordinates.
    pub map_repeat: [f32; 2],
    /// Handle of a map, as the next six are.
    pub base_color_map: u32,
    /// Light given off.
    pub emission_map: u32,
    /// Relief.
    pub normal_map: u32,
    /// Roughness.
    pub roughness_map: u32,
    /// Where it is metal.
    pub metalness_map: u32,
    /// How much of its surroundings it sees.
    pub occlusion_map: u32,
    /// Where there is no surface.
    pub alpha_mask: u32,
    /// Unused.
    pub material_padding_0: u32,
    /// Unused.
    pub material_padding_1: u32,
    /// Unused.
    pub material_padding_2: u32,
    /// What the pipeline's Fresnel term needs beside f0, as the next three are.
    pub fresnel_1: [f32; 3],
    /// Unused.
    pub material_padding_3: f32,
    /// As `fresnel_1`.
    pub fresnel_2: [f32; 3],
    /// Unused.
    pub material_padding_4: f32,
    /// As `fresnel_1`.
    pub fresnel_3: [f32; 3],
    /// Unused.
    pub material_padding_5: f32,
    /// As `fresnel_1`.
    pub fresnel_4: [f32; 3],
    /// Unused.
    pub material_padding_6: f32,
}
agree!(Material {
    albedo,
    opacity,
    f0,
    roughness,
    emission,
    shininess,
    effects,
    metalness,
    normal_scale,
    alpha_cutoff,
    map_repeat,
    base_color_map,
    emission_map,
    normal_map,
    roughness_map,
    metalness_map,
    occlusion_map,
    alpha_mask,
    material_padding_0,
    material_padding_1,
    material_padding_2,
    fresnel_1,
    material_padding_3,
    fresnel_2,
    material_padding_4,
    fresnel_3,
    material_padding_5,
    fresnel_4,
    material_padding_6
});

/// One light; see `shaders-glsl/interface/lights.glsl`.
#[derive(Clone, Copy, Pod, Zeroable, Debug)]
#[repr(C)]
pub struct Light {
    /// Position (w = 1) or direction to the light (w = 0).
    pub position: [f32; 4],
    /// Luminous intensity or illuminance.
    pub intensity: [f32; 3],
    /// Radius, or tangent of the angular radius.
    pub radius: f32,
    /// Direction of a spot's beam.
    pub axis: [f32; 3],
    /// Scale of a spot's falloff.
    pub cone_scale: f32,
    /// Offset of a spot's falloff.
    pub cone_offset: f32,
    /// Bits of the effects that it calls for.
    pub effects: u32,
    /// Its first shadow map.
    pub shadow_first: u32,
    /// Its shadow maps.
    pub shadow_count: u32,
}
agree!(Light {
    position,
    intensity,
    radius,
    axis,
    cone_scale,
    cone_offset,
    effects,
    shadow_first,
    shadow_count
});

/// One depth map of a lamp; see `shaders-glsl/interface/shadow_maps.glsl`.
#[derive(Clone, Copy, Pod, Zeroable, Debug)]
#[repr(C)]
pub struct ShadowMap {
    /// World to clip space, column by column; reversed depth.
    pub clip: [[f32; 4]; 4],
    /// Its inverse, transposed.
    pub planes: [[f32; 4]; 4],
}
agree!(ShadowMap { clip, planes });

/// The barest draws of the benchmark; see `shaders-glsl/interface/bare.glsl`.
#[derive(Clone, Copy, Pod, Zeroable, Debug)]
#[repr(C)]
pub struct Bare {
    /// Cells in a row.
    pub columns: u32,
    /// Rows.
    pub rows: u32,
    /// Triangles.
    pub draws: u32,
    /// Shades.
    pub shades: u32,
    /// Whether those of a shade follow each other.
    pub sorted: u32,
    /// Unused.
    pub bare_padding_0: u32,
    /// Unused.
    pub bare_padding_1: u32,
    /// Unused.
    pub bare_padding_2: u32,
}
agree!(Bare {
    columns,
    rows,
    draws,
    shades,
    sorted,
    bare_padding_0,
    bare_padding_1,
    bare_padding_2
});

/// What the probe evaluates a function at; see `shaders-glsl/interface/probe.glsl`.
#[derive(Clone, Copy, Pod, Zeroable, PartialEq, Debug)]
#[repr(C)]
pub struct ProbeInput {
    /// N.
    pub normal: [f32; 3],
    /// sigma or m.
    pub roughness: f32,
    /// L.
    pub light: [f32; 3],
    /// Reflectance at normal incidence.
    pub f0: f32,
    /// E.
    pub eye: [f32; 3],
    /// Which of its invocation's inputs it is.
    pub place: u32,
    /// What the function takes beside.
    pub extra: [f32; 4],
}
agree!(ProbeInput {
    normal,
    roughness,
    light,
    f0,
    eye,
    place,
    extra
});

impl ProbeInput {
    /// At N, L and E, with a roughness and an f0.
    pub fn new([normal, light, eye]: [[f32; 3]; 3], roughness: f32, f0: f32) -> Self {
        Self {
            normal,
            roughness,
            light,
            f0,
            eye,
            place: 0,
            extra: [0.0; 4],
        }
    }

    /// N, L and E.
    pub fn vectors(&self) -> [glam::Vec3; 3] {
        [self.normal, self.light, self.eye].map(glam::Vec3::from)
    }
}

/// What the probe answers.
#[derive(Clone, Copy, Default, Pod, Zeroable, PartialEq, Debug)]
#[repr(C)]
pub struct ProbeResult {
    /// The value.
    pub value: f32,
    /// How many values of the invocation are NaN.
    pub nans: u32,
    /// How many are infinite.
    pub infinities: u32,
    /// How many are below 0.
    pub negatives: u32,
}
agree!(ProbeResult {
    value,
    nans,
    infinities,
    negatives
});
