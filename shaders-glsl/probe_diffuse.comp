#version 460
// What do the matte bases of the ladder say, value by value?

#include "brdf/eon.glsl"
#include "brdf/fujii.glsl"
#include "brdf/full_oren_nayar.glsl"
#include "brdf/lambert.glsl"
#include "interface/probe.glsl"
#include "probe/tiers.glsl"

const int FUNCTION_LAMBERT = 0;
const int FUNCTION_FON = 1;
const int FUNCTION_EON = 2;
const int FUNCTION_FULL_OREN_NAYAR = 3;

// N.L, N.E and s = L.E - (N.L)(N.E).
vec3 cosines(ProbeInput p, int tier) {
    float NoL = cosine_in(tier, p.normal, p.light);
    float NoE = cosine_in(tier, p.normal, p.eye);
    float LoE = cosine_in(tier, p.light, p.eye);
    return vec3(NoL, NoE, LoE - NoL * NoE);
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
