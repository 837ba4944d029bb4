// How is a rough matte surface evaluated where light and eye are near its plane? With the products' lost digits.

#include "brdf/oren_nayar.glsl"
#include "math/double_float.glsl"

// `oren_nayar` with s = L.E - (N.L)(N.E) to 2^-44: near the surface s and N.L are small beside the products that
// they are made of, and in 32 bits those leave an error of 2e-7 / N.L.
float oren_nayar_compensated(OrenNayarWeights weights, vec3 N, vec3 L, vec3 E) {
    vec2 NoL = dot_double(N, L);
    vec2 NoE = dot_double(N, E);
    vec2 s = subtract_double(dot_double(L, E), multiply_double(NoL, NoE));
    return oren_nayar_lobe(weights, NoL.x, NoE.x, s.x);
}
