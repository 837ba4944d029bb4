// How does a metal's colour change with the angle, as its whole spectrum has it? Schlick's curve and four terms, fitted per metal and
// channel to Fresnel's equations integrated over wavelength (reference/spectral.rs).

#include "brdf/schlick.glsl"

// F = f0 + (f90 - f0) (1 - mu)^5 + mu (c1 (1 - mu)^6 + c2 (1 - mu)^2 + c3 (1 - mu)^14 + c4 (1 - mu)^30), at least 0. The terms are 0 at
// both ends. A channel may pass 1: gold's red lies outside sRGB.
vec3 F_Spectral(
    vec3 f0, float f90, vec3 c1, vec3 c2, vec3 c3, vec3 c4, float mu, float one_minus_mu
) {
    float x2 = one_minus_mu * one_minus_mu;
    float x4 = x2 * x2;
    float x6 = x4 * x2;
    float x14 = x6 * x6 * x2;
    float x30 = x14 * x14 * x2;
    vec3 F = f0 + (f90 - f0) * (x4 * one_minus_mu) + mu * (c1 * x6 + c2 * x2 + c3 * x14 + c4 * x30);
    return max(F, vec3(0.0));
}

// Its mean over the cosine: 2 int mu^2 (1 - mu)^p = 4 / ((p + 1) (p + 2) (p + 3)).
vec3 F_avg_Spectral(vec3 f0, float f90, vec3 c1, vec3 c2, vec3 c3, vec3 c4) {
    return f0 + (f90 - f0) / 21.0 + c1 / 126.0 + c2 / 15.0 + c3 / 1020.0 + c4 / 8184.0;
}
