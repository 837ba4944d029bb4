// How are facets that are small mirrors evaluated near a sharp peak, and near the surface? With the lost digits.

#include "brdf/cook_torrance.glsl"
#include "compensated/half_vector.glsl"
#include "math/double_float.glsl"

vec3 cook_torrance_compensated(vec3 N, vec3 L, vec3 E, float m2, vec3 f0, float f90) {
    float NoL = dot_compensated(N, L);
    float NoE = dot_compensated(N, E);
    return cook_torrance_lobe(half_vector_compensated(N, L, E, NoL, NoE), NoL, NoE, m2, f0, f90);
}
