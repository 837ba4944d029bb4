// How do Beckmann's facets hide one another? Smith 1967, light and eye correlated by height (Heitz 2014, eq. 99).

#include "brdf/beckmann.glsl"
#include "math/half_vector.glsl"

// G2 / (4 NoE), with G2 = 1 / (1 + Lambda(L) + Lambda(E)). Lambda is large where a direction grazes, at most 2^21.
float smith_shadowing(float lambda_l, float lambda_e, float NoE) {
    return 0.25 / (NoE * (1.0 + lambda_l + lambda_e));
}

// Lambda of a direction with cosine c > 0, of facets of roughness m: what Smith's G1 = 1 / (1 + Lambda) lacks. With
// u = c / (m sqrt(1 - c^2)), the rational form of Walter et al. 2007 (section 5.2): 3.1e-3 of 1 + Lambda at worst (u = 1.34). From
// u = 1.6 on it is 0; so the sine that is divided by is never 0. From u = 1.55 on the published form is below 0, by 6e-5 where it ends with
// a step: it is held at 0.
float beckmann_lambda_rational(float c, float m2) {
    float sine2 = max((1.0 - c) * (1.0 + c), 0.0);
    if (c * c >= 2.56 * m2 * sine2) {
        return 0.0;
    }
    float u = c * inversesqrt(m2 * sine2);
    return max(1.0 + u * (0.396 * u - 1.259), 0.0) / (u * (3.535 + 2.181 * u));
}

// The same to 3e-7 of 1 + Lambda. Lambda = ierfc(u) / (2 u), the integral of the complementary error function
// ierfc(u) = exp(-u^2) / sqrt(pi) - u erfc(u), whose quotient by exp(-u^2) is a polynomial in y = 1 / (1 + u / 2), interpolated at
// the eight Chebyshev nodes of y for u in [0, 4]. From u = 4 on Lambda is below 3e-10.
float beckmann_lambda(float c, float m2) {
    float sine2 = max((1.0 - c) * (1.0 + c), 0.0);
    if (c * c >= 16.0 * m2 * sine2) {
        return 0.0;
    }
    float u = c * inversesqrt(m2 * sine2);
    float y = 1.0 / (1.0 + 0.5 * u);
    float high = -0.95765760 + y * (1.7390949 + y * (-1.0189101 + y * 0.20447230));
    float scaled = -0.0012150237 + y * (0.019248324 + y * (-0.060604790 + y * (0.63976157 + y * high)));
    return exp(-u * u) * scaled / (2.0 * u);
}

// f NoL / F = D G2 / (4 NoE) for cosines of at least COS_MIN.
float beckmann_smith(HalfVector h, float NoL, float NoE, float m2) {
    float D = D_Beckmann(h.sine2, h.Noh * h.Noh, h.hh, m2);
    return D * smith_shadowing(beckmann_lambda_rational(NoL, m2), beckmann_lambda_rational(NoE, m2), NoE);
}

// The same with Smith's function to 3e-7 instead of 3.1e-3.
float beckmann_smith_exact(HalfVector h, float NoL, float NoE, float m2) {
    float D = D_Beckmann(h.sine2, h.Noh * h.Noh, h.hh, m2);
    return D * smith_shadowing(beckmann_lambda(NoL, m2), beckmann_lambda(NoE, m2), NoE);
}
