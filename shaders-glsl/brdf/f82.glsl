// How does a metal's colour dip before grazing? Schlick with Lazanyi and Szirmay-Kalos' term (2005), by the colour at 82 degrees
// (Kutz, Hasan and Edmondson 2021, "Novel aspects of the Adobe Standard Material").

#include "brdf/schlick.glsl"

// cos = 1/7, where mu (1 - mu)^6 is largest: (1/7) (6/7)^6, and (1 - mu)^5 = (6/7)^5.
const float F82_LARGEST = 0.05665278;
const float F82_RISE = 0.46266437;

// a of F = F_Schlick - a mu (1 - mu)^6. tint: F over F_Schlick at 82 degrees, 0..1; 1 is Schlick's.
vec3 f82_dip(vec3 f0, float f90, vec3 tint) {
    return (f0 + (f90 - f0) * F82_RISE) * (1.0 - tint) / F82_LARGEST;
}

// mu, one_minus_mu: cosine between light and facet normal, and 1 less it. Beside 82 degrees a dark tint dips below 0: there it is 0.
// Errs by 3e-6 of F_Schlick.
vec3 F_F82(vec3 f0, float f90, vec3 dip, float mu, float one_minus_mu) {
    float square = one_minus_mu * one_minus_mu;
    vec3 F = F_Schlick(f0, f90, one_minus_mu) - dip * (mu * square * square * square);
    return max(F, vec3(0.0));
}

// Its mean over the cosine: 2 int mu^2 (1 - mu)^6 = 1/126.
vec3 F_avg_F82(vec3 f0, float f90, vec3 dip) {
    return max(f0 + (f90 - f0) / 21.0 - dip / 126.0, vec3(0.0));
}
