// What do lobes of facets need of the half vector near a sharp peak, and near the surface? With the lost digits.

#include "math/double_float.glsl"
#include "math/half_vector.glsl"

// `half_vector` with its sine to 2^-34 of |h| and its cosine rounded once. L + E and L - E themselves need
// no more than 32 bits: each component errs by 2^-24 of itself, and their squares are added without cancellation.
HalfVector half_vector_compensated(vec3 N, vec3 L, vec3 E, float NoL, float NoE) {
    HalfVector h = half_vector(N, L, E, NoL, NoE);
    vec3 sine = cross_of_sum(N, L, E);
    h.sine2 = dot(sine, sine);
    return h;
}
