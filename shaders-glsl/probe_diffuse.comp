#version 460
// What do the matte bases of the ladder say, value by value?

#include "brdf/eon.glsl"
#include "brdf/fujii.glsl"
#include "brdf/full_oren_nayar.glsl"
#include "brdf/lambert.glsl"
#include "interface/probe.glsl"
#include "math/double_float.glsl"
#include "probe/constants.glsl"

const int FUNCTION_LAMBERT = 0;
const int FUNCTION_FON = 1;
const int FUNCTION_EON = 2;
const int FUNCTION_FULL_OREN_NAYAR = 3;

// N.L, N.E and s = L.E - (N.L)(N.E).
vec3 cosines(ProbeInput p, int tier) {
    if (tier == TIER_COMPENSATED) {
        vec2 NoL = dot_double(p.normal, p.light);
        vec2 NoE = dot_double(p.normal, p.eye);
        vec2 s = subtract_double(dot_double(p.light, p.eye), multiply_double(NoL, NoE));
        return vec3(NoL.x, NoE.x, s.x);
    }
    float NoL = dot(p.normal, p.light);
    float NoE = dot(p.normal, p.eye);
    return vec3(NoL, NoE, dot(p.light, p.eye) - NoL * NoE);
}

// pi f NoL, the albedo included where it does more than scale: extra.x.
float value_of(ProbeInput p, int tier) {
    vec3 at = cosines(p, tier);
    if (PROBE_FUNCTION == FUNCTION_LAMBERT) {
        return lambert(at.x);
    }
    if (PROBE_FUNCTION == FUNCTION_FULL_OREN_NAYAR) {
        float triple = dot(p.normal, cross(p.light, p.eye));
        FullOrenNayar lobe = full_oren_nayar_lobe(p.roughness, at.x, at.y, at.z, triple);
        return full_oren_nayar(lobe, p.extra.xxx).x;
    }
    OrenNayarWeights weights = fujii_weights(p.roughness);
    float once = fujii_lobe(weights, at.x, at.y, at.z);
    if (PROBE_FUNCTION == FUNCTION_FON) {
        return once;
    }
    return p.extra.x * once + eon_bounced(p.extra.xxx, p.roughness, weights, at.x, at.y).x;
}

#include "probe/evaluate.glsl"
