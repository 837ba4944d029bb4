// What light leaves a surface point towards the eye? One shader for every material and every lamp.
//
// An effect is a file in `effects/`: hooks that do nothing where nobody calls for it. Who includes this file has said
// where a draw's material comes from, as `material_of_draw`.

#include "interface/variants.glsl"
#include "interface/frame.glsl"
#include "interface/materials.glsl"
#include "interface/lights.glsl"
#include "math/direction.glsl"
#include "maps/derivatives.glsl"
#include "shading/models.glsl"
#include "shading/surface.glsl"
#include "light/incident.glsl"
#include "light/hemisphere.glsl"
#include "slides/phong.glsl"
#include "effects/alpha_mask.glsl"
#include "effects/base_color_map.glsl"
#include "effects/colored_f0.glsl"
#include "effects/diffuse_lobe.glsl"
#include "effects/emission.glsl"
#include "effects/emission_map.glsl"
#include "effects/metalness_map.glsl"
#include "effects/normal_map.glsl"
#include "effects/occlusion_map.glsl"
#include "effects/point_light.glsl"
#include "effects/rough_diffuse.glsl"
#include "effects/roughness_map.glsl"
#include "effects/shadow.glsl"
#include "effects/specular_lobe.glsl"
#include "effects/spot_light.glsl"
#include "effects/transparency.glsl"
#include "effects/two_sided.glsl"

layout(location = 0) in vec3 in_position; // world space, m
layout(location = 1) in vec3 in_normal;   // world space, any length
layout(location = 2) flat in uint in_material;
layout(location = 3) flat in float in_handedness;
layout(location = 4) in vec2 in_coordinates; // u right, v up
layout(location = 5) in vec4 in_tangent;     // world space, any length; w: handedness of the map

layout(location = 0) out vec4 out_colour; // radiance, cd/m^2, premultiplied by alpha

// The point as its material has it, before any effect: a front face, Lambert's base, no interface, a grey f0.
Surface plain_surface(Material material, vec3 position, vec3 normal) {
    vec3 E = direction_or(frame.eye.xyz - frame.eye.w * position, vec3(0.0, 1.0, 0.0));
    Surface surface;
    surface.effects = material.effects;
    surface.position = position;
    surface.facet = vec3(0.0);
    surface.facet_turn = 0.0;
    surface.facet_drift = 0.0;
    surface.N = direction_or(normal, E);
    surface.E = E;
    surface.albedo = material.albedo;
    surface.f0 = vec3(max(max(material.f0.r, material.f0.g), material.f0.b));
    surface.roughness = clamp(material.roughness, 0.0, 1.0);
    surface.emission = material.emission;
    surface.side = 1.0;
    surface.NoE = 0.0;
    surface.f90 = 0.0;
    surface.through = vec3(1.0);
    surface.fresnel_1 = material.fresnel_1;
    surface.fresnel_2 = material.fresnel_2;
    surface.fresnel_3 = material.fresnel_3;
    surface.fresnel_4 = material.fresnel_4;
    surface.missing = GgxMissing(0.0, vec4(0.0), vec4(0.0), 0.0);
    surface.between = vec3(0.0);
    surface.weights = OrenNayarWeights(1.0, 0.0);
    return surface;
}

// The classic has one ambient colour per material: albedo + f0, so that metals are not black.
Lobes classic_ambient(Surface surface) {
    vec3 colour = surface.albedo + surface.f0;
    return Lobes(colour * hemisphere_diffuse(frame.sky, frame.ground, surface.N), vec3(0.0));
}

Lobes phong_light(Surface surface, float shininess, Incident incident) {
    vec3 radiance = incident.illuminance * INV_PI;
    return Lobes(
        radiance * surface.albedo * PhongDiffuse(surface.N, incident.L),
        radiance * surface.f0 * PhongSpecular(surface.N, incident.L, surface.E, shininess)
    );
}

Lobes ambient(Surface surface) {
    if (LIGHTING != LIGHTING_MIXED) {
        return classic_ambient(surface);
    }
    Lobes lobes = Lobes(vec3(0.0), vec3(0.0));
    diffuse_ambient(lobes, surface, frame.sky, frame.ground);
    specular_ambient(lobes, surface, frame.sky, frame.ground);
    return lobes;
}

// What lamp number i sends to the eye.
Lobes lamp(uint i, Surface surface, float shininess) {
    Light light = lights[i];
    Incident incident = parallel_light(light);
    point_light(incident, light, surface.position);
    spot_light(incident, light);
    if (!incident.arrives) {
        return Lobes(vec3(0.0), vec3(0.0));
    }
    shadow(incident, light, surface);
    if (LIGHTING == LIGHTING_PHONG) {
        return phong_light(surface, shininess, incident);
    }
    if (LIGHTING == LIGHTING_SLIDES) {
        return slides_light(surface, incident);
    }
    return mixed_light(surface, incident);
}

// What light is made from.
vec4 inspected(Surface surface, uint number, Material material, MapPlace place) {
    if (INSPECTED == INSPECT_NORMAL) {
        return vec4(surface.N, float(number));
    }
    if (INSPECTED == INSPECT_EYE) {
        return vec4(surface.E, surface.roughness);
    }
    if (INSPECTED == INSPECT_POSITION) {
        Lobes open = Lobes(vec3(1.0), vec3(1.0));
        occlusion_map(open, surface, material, place);
        return vec4(surface.position, open.diffuse.r);
    }
    if (INSPECTED == INSPECT_ALBEDO) {
        return vec4(surface.albedo, 1.0);
    }
    if (INSPECTED == INSPECT_F0) {
        return vec4(surface.f0, 1.0);
    }
    if (INSPECTED == INSPECT_EMISSION) {
        vec3 radiance = vec3(0.0);
        emission(radiance, surface);
        return vec4(radiance, 1.0);
    }
    Light light = lights[uint(INSPECTED_LIGHT)];
    Incident incident = parallel_light(light);
    point_light(incident, light, surface.position);
    spot_light(incident, light);
    if (INSPECTED == INSPECT_SHADOW) {
        incident.illuminance = vec3(1.0);
        shadow(incident, light, surface);
        return vec4(incident.illuminance, 1.0);
    }
    float f0 = max(max(surface.f0.r, surface.f0.g), surface.f0.b);
    return vec4(incident.L, incident.arrives ? f0 : -1.0);
}

void main() {
    Material material = material_of_draw(in_material, in_coordinates);
    MapPlace place = map_place(in_coordinates, material.map_repeat);
    vec3 right = dFdx(in_position);
    vec3 down = dFdy(in_position);

    alpha_mask(material, place);
    Surface surface = plain_surface(material, in_position, in_normal);
    shadow_facet(surface, right, down);
    two_sided(surface, in_normal, in_handedness, gl_FrontFacing);
    base_color_map(surface, material, place);
    colored_f0(surface, material);
    roughness_map(surface, material, place);
    metalness_map(surface, material, place);
    emission_map(surface, material, place);
    normal_map(surface, material, place, in_normal, in_tangent);
    surface.NoE = dot(surface.N, surface.E);
    specular_interface(surface);
    rough_diffuse_weights(surface);
    if (INSPECTED != INSPECT_NOTHING) {
        out_colour = inspected(surface, in_material, material, place);
        return;
    }

    Lobes sum = Lobes(vec3(0.0), vec3(0.0));
    if (TERM_AMBIENT != 0) {
        sum = ambient(surface);
        occlusion_map(sum, surface, material, place);
    }
    for (uint i = 0u; i < frame.light_count; i++) {
        Lobes lobes = lamp(i, surface, material.shininess);
        if (TERM_DIFFUSE != 0) {
            sum.diffuse += lobes.diffuse;
        }
        if (TERM_SPECULAR != 0) {
            sum.specular += lobes.specular;
        }
    }

    float alpha = 1.0;
    transparency(sum, alpha, surface, material);
    vec3 radiance = sum.diffuse + sum.specular;
    emission(radiance, surface);
    out_colour = vec4(radiance, alpha);
}
