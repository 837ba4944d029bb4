// Which Fresnel term does this pipeline have?

#include "brdf/conductor.glsl"
#include "brdf/dielectric.glsl"
#include "brdf/f82.glsl"
#include "brdf/kulla_conty.glsl"
#include "brdf/schlick.glsl"
#include "brdf/spectral.glsl"
#include "interface/variants.glsl"
#include "math/direction.glsl"
#include "shading/surface.glsl"

// The slides have one number for all channels; what differs is the reflection's colour, as in slides_light.
vec3 scale_colour(vec3 f0) {
    float scale = max(max(f0.r, f0.g), f0.b);
    return scale >= LENGTH_MIN ? f0 / scale : vec3(1.0);
}

// Reflectance at a facet that sees the light at cosine mu.
vec3 F_interface(Surface surface, float mu, float one_minus_mu) {
    vec3 f0 = surface.f0;
    if (FRESNEL == FRESNEL_SCALE) {
        float scale = max(max(f0.r, f0.g), f0.b);
        return scale_colour(f0) * F_Schlick(vec3(scale), surface.f90, one_minus_mu).x;
    }
    if (FRESNEL == FRESNEL_F82) {
        return F_F82(f0, surface.f90, f82_dip(f0, surface.f90, surface.fresnel_1), mu, one_minus_mu);
    }
    if (FRESNEL == FRESNEL_DIELECTRIC) {
        return F_Dielectric(f0, clamp(mu, COS_MIN, 1.0));
    }
    if (FRESNEL == FRESNEL_CONDUCTOR) {
        return F_Conductor(surface.fresnel_1, surface.fresnel_2, clamp(mu, COS_MIN, 1.0));
    }
    if (FRESNEL == FRESNEL_SPECTRAL) {
        return F_Spectral(
            f0, surface.f90, surface.fresnel_1, surface.fresnel_2, surface.fresnel_3, surface.fresnel_4, mu, one_minus_mu
        );
    }
    return F_Schlick(f0, surface.f90, one_minus_mu);
}

// What is let through at a cosine of 0..1, 1 - F: as a sum where F has one.
vec3 T_interface(Surface surface, float mu) {
    vec3 f0 = surface.f0;
    if (FRESNEL == FRESNEL_SCALE) {
        vec3 colour = scale_colour(f0);
        float scale = max(max(f0.r, f0.g), f0.b);
        return (1.0 - colour) + colour * T_Schlick(vec3(scale), surface.f90, mu).x;
    }
    if (FRESNEL == FRESNEL_DIELECTRIC) {
        return T_Dielectric(f0, clamp(mu, COS_MIN, 1.0));
    }
    if (FRESNEL == FRESNEL_SCHLICK) {
        return T_Schlick(f0, surface.f90, mu);
    }
    if (FRESNEL == FRESNEL_SPECTRAL) {
        // A metal's own terms change nothing: there is no base below them. Gold's red passes 1.
        return max(T_Schlick(f0, surface.f90, mu), vec3(0.0));
    }
    return max(1.0 - F_interface(surface, mu, 1.0 - mu), vec3(0.0));
}

// The mean of F over the cosine, for what bounces between facets.
vec3 F_avg_interface(Surface surface) {
    vec3 f0 = surface.f0;
    if (FRESNEL == FRESNEL_SCALE) {
        float scale = max(max(f0.r, f0.g), f0.b);
        return scale_colour(f0) * F_avg_Schlick(vec3(scale), surface.f90).x;
    }
    if (FRESNEL == FRESNEL_F82) {
        return F_avg_F82(f0, surface.f90, f82_dip(f0, surface.f90, surface.fresnel_1));
    }
    if (FRESNEL == FRESNEL_DIELECTRIC) {
        return surface.fresnel_1;
    }
    if (FRESNEL == FRESNEL_CONDUCTOR) {
        return surface.fresnel_3;
    }
    if (FRESNEL == FRESNEL_SPECTRAL) {
        return F_avg_Spectral(
            f0, surface.f90, surface.fresnel_1, surface.fresnel_2, surface.fresnel_3, surface.fresnel_4
        );
    }
    return F_avg_Schlick(f0, surface.f90);
}
