#version 460
// What do the Fresnel terms of the ladder say, value by value, at the half vector of light and eye?

#include "brdf/conductor.glsl"
#include "brdf/dielectric.glsl"
#include "brdf/f82.glsl"
#include "brdf/schlick.glsl"
#include "brdf/spectral.glsl"
#include "interface/probe.glsl"
#include "math/constants.glsl"
#include "math/half_vector.glsl"
#include "probe/constants.glsl"

const int FUNCTION_F82 = 0;
const int FUNCTION_DIELECTRIC = 1;
const int FUNCTION_CONDUCTOR = 2;
const int FUNCTION_SPECTRAL = 3;

float value_of(ProbeInput p, int tier) {
    // N.h is not asked for.
    HalfVector h = half_vector(p.normal, p.light, p.eye, 0.0, 0.0);
    float mu = half_cosine(h);
    float one_minus_mu = half_rest(h);
    vec3 f0 = vec3(p.f0);
    float f90 = f90_of(f0);
    if (PROBE_FUNCTION == FUNCTION_F82) {
        return F_F82(f0, f90, f82_dip(f0, f90, p.extra.xxx), mu, one_minus_mu).x;
    }
    if (PROBE_FUNCTION == FUNCTION_DIELECTRIC) {
        return F_dielectric(p.f0, clamp(mu, COS_MIN, 1.0));
    }
    if (PROBE_FUNCTION == FUNCTION_CONDUCTOR) {
        return F_conductor(p.extra.x, p.extra.y, clamp(mu, COS_MIN, 1.0));
    }
    return F_Spectral(f0, f90, p.extra.xxx, p.extra.yyy, p.extra.zzz, p.extra.www, mu, one_minus_mu).x;
}

#include "probe/evaluate.glsl"
