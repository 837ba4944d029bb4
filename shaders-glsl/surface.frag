#version 460
// What light leaves a surface point towards the eye? One shader for every material and every lamp.

#include "interface/variants.glsl"
#include "interface/frame.glsl"
#include "interface/materials.glsl"
#include "interface/lights.glsl"
#include "math/direction.glsl"
#include "light/punctual.glsl"
#include "light/hemisphere.glsl"
#include "slides/phong.glsl"
#include "slides/oren_nayar.glsl"
#include "slides/cook_torrance.glsl"
#include "brdf/coupled.glsl"

layout(location = 0) in vec3 in_position; // world space, m
layout(location = 1) in vec3 in_normal;   // world space, any length
layout(location = 2) flat in uint in_material;
layout(location = 3) flat in float in_handedness;

layout(location = 0) out vec4 out_colour; // radiance, cd/m^2, premultiplied by alpha

// A face seen from behind turns its normal. A mirroring map turns the winding too, so it decides with
// handedness which side is the front. A normal without direction faces the eye.
vec3 facing_normal(vec3 normal, vec3 E, float handedness, bool front_facing) {
    float side = front_facing ? handedness : -handedness;
    return side * direction_or(normal, side * E);
}

// The classic has one ambient colour per material: albedo + f0, so that metals are not black.
Lobes classic_ambient(Material material, vec3 N) {
    return Lobes((material.albedo + material.f0) * hemisphere_diffuse(frame.sky, frame.ground, N), vec3(0.0));
}

Lobes phong_light(Material material, vec3 N, vec3 E, Incident incident) {
    vec3 radiance = incident.illuminance * INV_PI;
    return Lobes(
        radiance * material.albedo * PhongDiffuse(N, incident.L),
        radiance * material.f0 * PhongSpecular(N, incident.L, E, material.shininess)
    );
}

// The deck scales one Fresnel number; a material has three. The largest channel of f0 is FresnelScale, and f0
// divided by it the colour of the reflection, so that at normal incidence their product is f0.
// The deck leaves the light's factor open: illuminance / pi stands before both listings, and no further cosine.
Lobes slides_light(Material material, vec3 N, vec3 E, Incident incident) {
    vec3 radiance = incident.illuminance * INV_PI;
    float FresnelScale = max(max(material.f0.r, material.f0.g), material.f0.b);
    vec3 specular = FresnelScale > 0.0 ? material.f0 / FresnelScale : vec3(1.0);
    float Roughness = material.roughness;
    return Lobes(
        radiance * material.albedo * SlidesOrenNayar(N, incident.L, E, Roughness),
        radiance * specular * SlidesCookTorrance(N, incident.L, E, Roughness, FresnelScale)
    );
}

Lobes corrected_light(CoupledSurface surface, Incident incident) {
    Lobes lobes = coupled(surface, incident.L, incident.r2);
    return Lobes(incident.illuminance * lobes.diffuse, incident.illuminance * lobes.specular);
}

void main() {
    Material material = materials[in_material];
    vec3 E = direction_or(frame.eye.xyz - frame.eye.w * in_position, vec3(0.0, 1.0, 0.0));
    vec3 N = facing_normal(in_normal, E, in_handedness, gl_FrontFacing);
    CoupledSurface surface = coupled_surface(N, E, material.albedo, material.f0, material.roughness);

    Lobes sum = Lobes(vec3(0.0), vec3(0.0));
    if (TERM_AMBIENT != 0) {
        if (LIGHTING == LIGHTING_CORRECTED) {
            sum = coupled_ambient(surface, frame.sky, frame.ground);
        } else {
            sum = classic_ambient(material, N);
        }
    }
    for (uint i = 0u; i < frame.light_count; i++) {
        Light light = lights[i];
        Incident incident;
        if (!incident_from(light.position, light.intensity, light.radius, light.axis, light.cone_scale,
                light.cone_offset, in_position, incident)) {
            continue;
        }
        Lobes lobes;
        if (LIGHTING == LIGHTING_PHONG) {
            lobes = phong_light(material, N, E, incident);
        } else if (LIGHTING == LIGHTING_SLIDES) {
            lobes = slides_light(material, N, E, incident);
        } else {
            lobes = corrected_light(surface, incident);
        }
        if (TERM_DIFFUSE != 0) {
            sum.diffuse += lobes.diffuse;
        }
        if (TERM_SPECULAR != 0) {
            sum.specular += lobes.specular;
        }
    }

    // A corrected interface hides what it reflects away, so it covers even where the base is clear.
    float alpha = material.opacity;
    if (LIGHTING == LIGHTING_CORRECTED) {
        float F = max(max(surface.F.r, surface.F.g), surface.F.b);
        alpha = 1.0 - (1.0 - alpha) * (1.0 - F);
    }
    out_colour = vec4(material.opacity * sum.diffuse + sum.specular + material.emission, alpha);
}
