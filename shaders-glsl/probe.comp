#version 460
// What do the lighting functions say, value by value: for inputs from the host, or drawn by chance?

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
#include "math/direction.glsl"
#include "math/hash.glsl"
#include "slides/cook_torrance.glsl"
#include "slides/oren_nayar.glsl"

layout(local_size_x = 64) in;

layout(constant_id = 64) const int PROBE_FUNCTION = 0; // one of the FUNCTION_ values
layout(constant_id = 65) const int PROBE_TIER = 0;     // one of the TIER_ values
layout(constant_id = 66) const int PROBE_SOURCE = 0;   // one of the SOURCE_ values

const int FUNCTION_OREN_NAYAR = 0;
const int FUNCTION_COOK_TORRANCE = 1;
const int FUNCTION_BECKMANN_D = 2;
const int FUNCTION_SCHLICK_F = 3;
const int FUNCTION_V_CAVITY_G = 4;
const int FUNCTION_CORRECTED = 5;
const int FUNCTION_SLIDES_OREN_NAYAR = 6;
const int FUNCTION_SLIDES_COOK_TORRANCE = 7;
const int FUNCTION_NOTHING = 8; // what an evaluation costs without its function

const int TIER_F32 = 0;
const int TIER_COMPENSATED = 1;
const int TIER_HALF = 2;

const int SOURCE_HOST = 0;
const int SOURCE_CHANCE = 1; // each invocation keeps its last input, or the first whose value is no number or below 0
const int SOURCE_WORST = 2;  // each keeps the input at which the tiers differ most
const int SOURCE_AGAIN = 3;  // the host's inputs in turn, for the clock; the result is their values' sum

// Evaluations of an input for the clock, so that reading it weighs little, and what moves it in between: 2^-20.
const uint AGAIN = 16u;
const float NUDGE = 9.5367431640625e-7;

// The least m that the lobe itself is asked for; the picture's materials stop at M_MIN.
const float PROBED_M_MIN = 1.0e-4;

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
    float NoL = dot(p.normal, p.light);
    float NoE = dot(p.normal, p.eye);
    if (tier == TIER_COMPENSATED) {
        NoL = dot_double(p.normal, p.light).x;
        NoE = dot_double(p.normal, p.eye).x;
    }
    float into = T_Schlick(f0, f90, clamp(NoL, 0.0, 1.0)).x;
    float out_of = T_Schlick(f0, f90, clamp(NoE, 0.0, 1.0)).x;
    float base = into * out_of * (oren_nayar_value(p, tier) * INV_PI);
    return base + cook_torrance_value(p, tier, beckmann_m2(p.roughness, 0.0));
}

float facet_value(ProbeInput p, int tier) {
    float NoL = dot(p.normal, p.light);
    float NoE = dot(p.normal, p.eye);
    if (tier == TIER_COMPENSATED) {
        NoL = dot_double(p.normal, p.light).x;
        NoE = dot_double(p.normal, p.eye).x;
    }
    if (NoL < COS_MIN || NoE < COS_MIN) {
        return 0.0;
    }
    HalfVector h = half_vector(p.normal, p.light, p.eye, NoL, NoE);
    if (tier == TIER_COMPENSATED) {
        h = half_vector_compensated(p.normal, p.light, p.eye, NoL, NoE);
    }
    if (PROBE_FUNCTION == FUNCTION_V_CAVITY_G) {
        return G_VCavity(NoL, NoE, h.hh);
    }
    float m = max(p.roughness, PROBED_M_MIN);
    float Noh2 = h.Noh * h.Noh;
    return D_Beckmann(h.sine2 / Noh2, h.hh / Noh2, m * m);
}

float schlick_value(ProbeInput p, int tier) {
    vec3 difference = p.light - p.eye;
    vec3 h = p.light + p.eye;
    float one_minus_cos = 0.25 * dot(difference, difference) / (1.0 + 0.5 * sqrt(dot(h, h)));
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

// Uniform over the sphere; rounding and Vulkan's loose sine leave it a unit vector all the same.
vec3 any_direction(inout uint state) {
    float z = 2.0 * fraction(state) - 1.0;
    float around = 6.2831853 * fraction(state);
    float across = sqrt(max(1.0 - z * z, 0.0));
    return direction_or(vec3(across * cos(around), across * sin(around), z), vec3(0.0, 1.0, 0.0));
}

// At a cosine from 1 down to 2^-27 (COS_MIN is 2^-22), each octave as likely as the next.
vec3 grazing_direction(vec3 N, vec3 across, inout uint state) {
    float cosine = exp2(-27.0 * fraction(state));
    float sine = sqrt(max(1.0 - cosine * cosine, 0.0));
    return direction_or(N * cosine + across * sine, N);
}

// A direction along the surface.
vec3 any_tangent(vec3 N, inout uint state) {
    vec3 tangent = cross(N, any_direction(state));
    return direction_or(tangent, abs(N.x) < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 0.0, 1.0));
}

// A quarter of the inputs each: everywhere; near the mirror direction; near the surface; both on opposite sides of it.
ProbeInput drawn(inout uint state, uint place) {
    ProbeInput p;
    state = hashed(state);
    uint kind = state >> 30u;
    p.place = place;
    p.normal = any_direction(state);
    p.roughness = exp2(-13.2877 * fraction(state)); // 1 down to 1e-4
    p.f0 = fraction(state);
    vec3 across = any_tangent(p.normal, state);
    p.light = kind == 0u ? any_direction(state) : grazing_direction(p.normal, across, state);
    p.eye = any_direction(state);
    if (kind == 1u) {
        vec3 aside = any_tangent(p.normal, state) * (4.0 * p.roughness * fraction(state));
        p.eye = direction_or(reflect(-p.light, direction_or(p.normal + aside, p.normal)), p.normal);
    }
    if (kind == 2u) {
        p.eye = grazing_direction(p.normal, any_tangent(p.normal, state), state);
    }
    if (kind == 3u) {
        float cosine = exp2(-27.0 * fraction(state));
        p.eye = direction_or(p.normal * (cosine + dot(p.normal, p.light)) - p.light, p.normal);
    }
    return p;
}

// Whether accuracy is promised there: 1e-6 above the surface (0.01 in 16 bits), and where a lobe is at least 1e-6 of its peak, e^-13.8.
bool promised(ProbeInput p) {
    float NoL = dot_double(p.normal, p.light).x;
    float NoE = dot_double(p.normal, p.eye).x;
    float least = PROBE_TIER == TIER_HALF ? 1.0e-2 : 1.0e-6;
    if (PROBE_FUNCTION != FUNCTION_SCHLICK_F && min(NoL, NoE) < least) {
        return false;
    }
    if (PROBE_FUNCTION == FUNCTION_OREN_NAYAR || PROBE_FUNCTION == FUNCTION_V_CAVITY_G
        || PROBE_FUNCTION == FUNCTION_SCHLICK_F || PROBE_FUNCTION == FUNCTION_SLIDES_OREN_NAYAR) {
        return true;
    }
    float m = max(p.roughness, PROBE_FUNCTION == FUNCTION_CORRECTED ? M_MIN : PROBED_M_MIN);
    HalfVector h = half_vector_compensated(p.normal, p.light, p.eye, NoL, NoE);
    return h.sine2 <= 13.8 * h.Noh * h.Noh * m * m;
}

// How far the tiers are apart, of the better one; 0 where nothing is promised.
float apart(ProbeInput p, float value) {
    if (!promised(p)) {
        return 0.0;
    }
    float better = value_of(p, TIER_COMPENSATED);
    return abs(value - better) / max(abs(better), 1.0e-30);
}

bool tally(inout ProbeResult sum, float value) {
    uint bits = floatBitsToUint(value);
    bool special = (bits & 0x7f800000u) == 0x7f800000u;
    bool nan = special && (bits & 0x007fffffu) != 0u;
    bool negative = !nan && bits > 0x80000000u;
    sum.nans += nan ? 1u : 0u;
    sum.infinities += special && !nan ? 1u : 0u;
    sum.negatives += negative ? 1u : 0u;
    return special || negative;
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= probe_count) {
        return;
    }
    ProbeResult sum = ProbeResult(0.0, 0u, 0u, 0u);
    if (PROBE_SOURCE == SOURCE_HOST) {
        sum.value = value_of(probe_inputs[i], PROBE_TIER);
        tally(sum, sum.value);
        probe_results[i] = sum;
        return;
    }
    if (PROBE_SOURCE == SOURCE_AGAIN) {
        for (uint place = 0u; place < probe_repeats; place++) {
            ProbeInput p = probe_inputs[(i + place) % probe_count];
            for (uint again = 0u; again < AGAIN; again++) {
                sum.value += value_of(p, PROBE_TIER);
                // Nothing may be kept from one evaluation to the next.
                p.normal.z += NUDGE;
                p.light.y += NUDGE;
                p.eye.x += NUDGE;
                p.roughness += NUDGE;
            }
        }
        probe_results[i] = sum;
        return;
    }
    uint state = hashed(hashed(probe_first + i) ^ probe_seed);
    ProbeInput kept = ProbeInput(vec3(0.0), 0.0, vec3(0.0), 0.0, vec3(0.0), 0u);
    bool bad = false;
    float worst = -1.0;
    for (uint place = 0u; place < probe_repeats; place++) {
        ProbeInput p = drawn(state, place);
        float value = value_of(p, PROBE_TIER);
        bool is_bad = tally(sum, value);
        float distance = PROBE_SOURCE == SOURCE_WORST ? apart(p, value) : float(place);
        if (is_bad && !bad || !bad && distance > worst) {
            kept = p;
            sum.value = value;
            worst = distance;
        }
        bad = bad || is_bad;
    }
    probe_inputs[i] = kept;
    probe_results[i] = sum;
}
