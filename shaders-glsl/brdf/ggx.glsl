// How do facets with a long tail of slopes reflect? Walter et al. 2007 (GGX, Trowbridge and Reitz 1975), Smith's shadowing
// correlated by height (Heitz 2014).

#include "math/constants.glsl"
#include "math/half_vector.glsl"

// Distribution per steradian, normalised as D_Beckmann is: a2 / (pi (cos^2 (a2 - 1) + 1)^2). Here of h = L + E, never normalised, and
// as a sum: sin^2 + a2 cos^2 loses no digits near the peak. sine2 = |N x h|^2, Noh = N.h >= 2^-21, hh = h.h <= 4.
// Errs by 1e-6 of itself and by what sine2 brings: 1e-6 / alpha + 3e-6 / min(NoL, NoE) in 32 bits.
float D_GGX(float sine2, float Noh, float hh, float alpha2) {
    float width = sine2 + alpha2 * Noh * Noh;
    float peak = hh / width;
    return alpha2 * INV_PI * peak * peak;
}

// G2 / (4 NoL NoE) for cosines of at least COS_MIN; at most 2^21 / alpha. Errs by 1e-6 of itself.
float V_SmithGGXCorrelated(float NoL, float NoE, float alpha2) {
    float of_light = NoL * sqrt(alpha2 + (1.0 - alpha2) * NoE * NoE);
    float of_eye = NoE * sqrt(alpha2 + (1.0 - alpha2) * NoL * NoL);
    return 0.5 / (of_light + of_eye);
}

// f NoL / F = D G2 / (4 NoE) for cosines of at least COS_MIN.
float ggx(HalfVector h, float NoL, float NoE, float alpha2) {
    return D_GGX(h.sine2, h.Noh, h.hh, alpha2) * (V_SmithGGXCorrelated(NoL, NoE, alpha2) * NoL);
}
