// How is a function of the library evaluated, at inputs from the host or drawn by chance? Who includes this file has said what it
// is, as `value_of`.

#include "brdf/beckmann.glsl"
#include "compensated/half_vector.glsl"
#include "interface/probe.glsl"
#include "math/direction.glsl"
#include "math/double_float.glsl"
#include "math/hash.glsl"
#include "probe/constants.glsl"

layout(local_size_x = 64) in;

layout(constant_id = 66) const int PROBE_SOURCE = 0; // one of the SOURCE_ values
layout(constant_id = 67) const int PROBE_SHAPE = 0;  // one of the SHAPE_ values

// Where a function is promised to be accurate.
const int SHAPE_FLAT = 0;    // whatever the angles
const int SHAPE_COSINES = 1; // light and eye above the surface
const int SHAPE_LOBE = 2;    // the same, and near enough to a peak
const int SHAPE_CLAMPED = 3; // the same, of a width of at least M_MIN

const int SOURCE_HOST = 0;
const int SOURCE_CHANCE = 1; // each invocation keeps its last input, or the first whose value is no number or below 0
const int SOURCE_WORST = 2;  // each keeps the input at which the tiers differ most
const int SOURCE_AGAIN = 3;  // the host's inputs in turn, for the clock; the result is their values' sum

// Evaluations of an input for the clock, so that reading it weighs little, and what moves it in between: 2^-20.
const uint AGAIN = 16u;
const float NUDGE = 9.5367431640625e-7;

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
    p.extra.x = mix(probe_low.x, probe_high.x, fraction(state));
    p.extra.y = mix(probe_low.y, probe_high.y, fraction(state));
    p.extra.z = mix(probe_low.z, probe_high.z, fraction(state));
    p.extra.w = mix(probe_low.w, probe_high.w, fraction(state));
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
    if (PROBE_SHAPE == SHAPE_FLAT) {
        return true;
    }
    float NoL = dot_compensated(p.normal, p.light);
    float NoE = dot_compensated(p.normal, p.eye);
    if (min(NoL, NoE) < (PROBE_TIER == TIER_HALF ? 1.0e-2 : 1.0e-6)) {
        return false;
    }
    if (PROBE_SHAPE == SHAPE_COSINES) {
        return true;
    }
    float m = max(p.roughness, PROBE_SHAPE == SHAPE_CLAMPED ? M_MIN : PROBED_M_MIN);
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
    ProbeInput kept = ProbeInput(vec3(0.0), 0.0, vec3(0.0), 0.0, vec3(0.0), 0u, vec4(0.0));
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
