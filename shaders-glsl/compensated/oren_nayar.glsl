// How is a rough matte surface evaluated where light and eye are near its plane? With the products' lost digits.

#include "brdf/oren_nayar.glsl"
#include "math/double_float.glsl"

// `oren_nayar` with cosines to 2^-23 of themselves. Near the surface they are small beside the products that they are made of, and
// 32 bits leave an error of 2e-7 / N.L. s needs no more than three such cosines: it is wrong by at most 6e-7 (ten halves of a unit in
// the last place) of itself where L.E is more than twice the product, and of (N.L)(N.E) elsewhere, beside N.L in the sum.
float oren_nayar_compensated(OrenNayarWeights weights, vec3 N, vec3 L, vec3 E) {
    return oren_nayar(weights, dot_compensated(N, L), dot_compensated(N, E), dot_compensated(L, E));
}
