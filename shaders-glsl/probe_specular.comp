#version 460
// What do the facets of the ladder say, value by value, under Schlick's Fresnel term?

#include "brdf/beckmann_smith.glsl"
#include "brdf/blinn_phong.glsl"
#include "brdf/ggx.glsl"
#include "brdf/ggx_missing.glsl"
#include "brdf/kulla_conty.glsl"
#include "brdf/schlick.glsl"
#include "interface/probe.glsl"
#include "probe/tiers.glsl"

const int FUNCTION_BLINN_PHONG = 0;
const int FUNCTION_BECKMANN_SMITH = 1;
const int FUNCTION_BECKMANN_SMITH_EXACT = 2;
const int FUNCTION_GGX = 3;
const int FUNCTION_GGX_MULTI = 4;

// f NoL.
float value_of(ProbeInput p, int tier) {
    float NoL = cosine_in(tier, p.normal, p.light);
    float NoE = cosine_in(tier, p.normal, p.eye);
    if (NoL < COS_MIN || NoE < COS_MIN) {
        return 0.0;
    }
    HalfVector h = half_vector_in(tier, p.normal, p.light, p.eye, NoL, NoE);
    float m = max(p.roughness, PROBED_M_MIN);
    vec3 f0 = vec3(p.f0);
    float f90 = f90_of(f0);
    float F = F_Schlick(f0, f90, half_rest(h)).x;
    if (PROBE_FUNCTION == FUNCTION_BLINN_PHONG) {
        return F * blinn_phong(h.sine2 / (h.Noh * h.Noh), NoL, m * m);
    }
    if (PROBE_FUNCTION == FUNCTION_BECKMANN_SMITH) {
        return F * beckmann_smith(h, NoL, NoE, m * m);
    }
    if (PROBE_FUNCTION == FUNCTION_BECKMANN_SMITH_EXACT) {
        return F * beckmann_smith_exact(h, NoL, NoE, m * m);
    }
    float once = F * ggx(h, NoL, NoE, m * m);
    if (PROBE_FUNCTION == FUNCTION_GGX) {
        return once;
    }
    GgxMissing missing = ggx_missing_of(m);
    float missing_l = ggx_missing(missing, min(NoL, 1.0));
    float missing_e = ggx_missing(missing, min(NoE, 1.0));
    vec3 between = kulla_conty(missing_e, missing.mean, F_avg_Schlick(f0, f90));
    return once + between.x * (missing_l * NoL);
}

#include "probe/evaluate.glsl"
