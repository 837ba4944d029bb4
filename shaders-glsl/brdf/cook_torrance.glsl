// How do facets that are small mirrors reflect? Cook and Torrance 1982, rightly normalised.

#include "math/constants.glsl"
#include "brdf/beckmann.glsl"
#include "brdf/schlick.glsl"
#include "brdf/v_cavity.glsl"

// What the lobe needs of h = L + E, which is never normalised.
struct HalfVector {
    float Noh;         // N.h = N.L + N.E
    float sine2;       // |N x h|^2
    float hh;          // h.h, at least Noh^2
    float difference2; // |L - E|^2 = 4 - hh
};

// tan^2 comes from the cross product, which keeps the digits that 1 - (N.H)^2 loses. |h| >= N.h, which rounding breaks
// where L is close to -E, so hh is held to it.
HalfVector half_vector(vec3 N, vec3 L, vec3 E, float NoL, float NoE) {
    vec3 h = L + E;
    vec3 difference = L - E;
    vec3 sine = cross(N, h);
    float Noh = NoL + NoE;
    return HalfVector(Noh, dot(sine, sine), max(dot(h, h), Noh * Noh), dot(difference, difference));
}

// f NoL = D F G / (4 NoE), with D normalised; NoL = N.L and NoE = N.E at least COS_MIN; m2 of beckmann_m2.
//
// E.H = |h|/2, and 1 - E.H = |L-E|^2 / (4 (1 + E.H)) because |L+E|^2 + |L-E|^2 = 4: no cancellation, never negative.
// N.h >= 2^-21, so every divisor is at least 2^-42, and the lobe finite. Errs as D_Beckmann does.
vec3 cook_torrance_lobe(HalfVector h, float NoL, float NoE, float m2, vec3 f0, float f90) {
    float Noh2 = h.Noh * h.Noh;
    float LoH = 0.5 * sqrt(h.hh);
    float D = D_Beckmann(h.sine2 / Noh2, h.hh / Noh2, m2);
    vec3 F = F_Schlick(f0, f90, 0.25 * h.difference2 / (1.0 + LoH));
    float G = G_VCavity(NoL, NoE, h.hh);
    return F * (D * G * 0.25 / NoE);
}

// The same for unit vectors N, L, E; 0 for a light or an eye at or below the surface.
vec3 cook_torrance(vec3 N, vec3 L, vec3 E, float NoL, float NoE, float m2, vec3 f0, float f90) {
    if (NoL < COS_MIN || NoE < COS_MIN) {
        return vec3(0.0);
    }
    return cook_torrance_lobe(half_vector(N, L, E, NoL, NoE), NoL, NoE, m2, f0, f90);
}
