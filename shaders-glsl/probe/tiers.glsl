// With which arithmetic are the angles made that a lobe is asked for?

#include "compensated/half_vector.glsl"
#include "math/double_float.glsl"
#include "probe/constants.glsl"

float cosine_in(int tier, vec3 a, vec3 b) {
    return tier == TIER_COMPENSATED ? dot_compensated(a, b) : dot(a, b);
}

HalfVector half_vector_in(int tier, vec3 N, vec3 L, vec3 E, float NoL, float NoE) {
    if (tier == TIER_COMPENSATED) {
        return half_vector_compensated(N, L, E, NoL, NoE);
    }
    return half_vector(N, L, E, NoL, NoE);
}
