#version 460
// What do the slides' models say, value by value: as the listings have them, and as frames are shaded by default?

#include "brdf/beckmann.glsl"
#include "brdf/cook_torrance.glsl"
#include "brdf/oren_nayar.glsl"
#include "brdf/schlick.glsl"
#include "brdf/v_cavity.glsl"
#include "compensated/cook_torrance.glsl"
#include "compensated/oren_nayar.glsl"
#include "half/oren_nayar.glsl"
#include "half/schlick.glsl"
#include "interface/probe.glsl"
#include "probe/tiers.glsl"
#include "slides/cook_torrance.glsl"
#include "slides/oren_nayar.glsl"

const int FUNCTION_OREN_NAYAR = 0;
const int FUNCTION_COOK_TORRANCE = 1;
const int FUNCTION_BECKMANN_D = 2;
const int FUNCTION_SCHLICK_F = 3;
const int FUNCTION_V_CAVITY_G = 4;
const int FUNCTION_CORRECTED = 5;
const int FUNCTION_SLIDES_OREN_NAYAR = 6;
const int FUNCTION_SLIDES_COOK_TORRANCE = 7;
const int FUNCTION_NOTHING = 8; // what an evaluation costs without its function

float oren_nayar_value(ProbeInput p, int tier) {
    OrenNayarWeights weights = oren_nayar_weights(p.roughness);
    if (tier == TIER_COMPENSATED) {
        return oren_nayar_compensated(weights, p.normal, p.light, p.eye);
    }
    float NoL = dot(p.normal, p.light);
    float NoE = dot(p.normal, p.eye);
    float LoE = dot(p.light, p.eye);
    if (tier == TIER_HALF) {
        return oren_nayar_half(p.roughness, NoL, NoE, LoE);
    }
    return oren_nayar(weights, NoL, NoE, LoE);
}

float cook_torrance_value(ProbeInput p, int tier, float m2) {
    vec3 f0 = vec3(p.f0);
    float f90 = f90_of(f0);
    if (tier == TIER_COMPENSATED) {
        return cook_torrance_compensated(p.normal, p.light, p.eye, m2, f0, f90).x;
    }
    float NoL = dot(p.normal, p.light);
    float NoE = dot(p.normal, p.eye);
    return cook_torrance(p.normal, p.light, p.eye, NoL, NoE, m2, f0, f90).x;
}

// What surface.frag adds up for one lamp of 1 lx, albedo 1 and no extent: base under its interface, and the interface.
float corrected_value(ProbeInput p, int tier) {
    vec3 f0 = vec3(p.f0);
    float f90 = f90_of(f0);
    float NoL = cosine_in(tier, p.normal, p.light);
    float NoE = cosine_in(tier, p.normal, p.eye);
    float into = T_Schlick(f0, f90, clamp(NoL, 0.0, 1.0)).x;
    float out_of = T_Schlick(f0, f90, clamp(NoE, 0.0, 1.0)).x;
    float base = into * out_of * (oren_nayar_value(p, tier) * INV_PI);
    return base + cook_torrance_value(p, tier, beckmann_m2(p.roughness, 0.0));
}

float facet_value(ProbeInput p, int tier) {
    float NoL = cosine_in(tier, p.normal, p.light);
    float NoE = cosine_in(tier, p.normal, p.eye);
    if (NoL < COS_MIN || NoE < COS_MIN) {
        return 0.0;
    }
    HalfVector h = half_vector_in(tier, p.normal, p.light, p.eye, NoL, NoE);
    if (PROBE_FUNCTION == FUNCTION_V_CAVITY_G) {
        return G_VCavity(NoL, NoE, h.hh);
    }
    float m = max(p.roughness, PROBED_M_MIN);
    return D_Beckmann(h.sine2, h.Noh * h.Noh, h.hh, m * m);
}

float schlick_value(ProbeInput p, int tier) {
    // N.h is not asked for.
    float one_minus_cos = half_rest(half_vector(p.normal, p.light, p.eye, 0.0, 0.0));
    if (tier == TIER_HALF) {
        return F_Schlick_half(p.f0, one_minus_cos);
    }
    return F_Schlick(vec3(p.f0), f90_of(vec3(p.f0)), one_minus_cos).x;
}

float value_of(ProbeInput p, int tier) {
    if (PROBE_FUNCTION == FUNCTION_OREN_NAYAR) {
        return oren_nayar_value(p, tier);
    }
    if (PROBE_FUNCTION == FUNCTION_COOK_TORRANCE) {
        float m = max(p.roughness, PROBED_M_MIN);
        return cook_torrance_value(p, tier, m * m);
    }
    if (PROBE_FUNCTION == FUNCTION_BECKMANN_D || PROBE_FUNCTION == FUNCTION_V_CAVITY_G) {
        return facet_value(p, tier);
    }
    if (PROBE_FUNCTION == FUNCTION_SCHLICK_F) {
        return schlick_value(p, tier);
    }
    if (PROBE_FUNCTION == FUNCTION_CORRECTED) {
        return corrected_value(p, tier);
    }
    if (PROBE_FUNCTION == FUNCTION_SLIDES_OREN_NAYAR) {
        return SlidesOrenNayar(p.normal, p.light, p.eye, p.roughness);
    }
    if (PROBE_FUNCTION == FUNCTION_SLIDES_COOK_TORRANCE) {
        return SlidesCookTorrance(p.normal, p.light, p.eye, p.roughness, p.f0);
    }
    return p.light.x + p.eye.y + p.normal.z + p.roughness + p.f0;
}

#include "probe/evaluate.glsl"
