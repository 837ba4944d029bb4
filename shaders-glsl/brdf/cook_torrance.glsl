// How do facets that are small mirrors reflect? Cook and Torrance 1982, rightly normalised.

#include "math/constants.glsl"
#include "brdf/beckmann.glsl"
#include "brdf/schlick.glsl"
#include "brdf/v_cavity.glsl"

// f NoL = D F G / (4 NoE), with D normalised. N, L, E unit vectors; NoL = N.L, NoE = N.E; m2 of beckmann_m2.
//
// The half vector h = L + E is never normalised: N.h = NoL + NoE, E.H = |h|/2, and 1 - E.H = |L-E|^2 / (4 (1 + E.H))
// because |L+E|^2 + |L-E|^2 = 4: no cancellation, never negative. tan^2 comes from the cross product, which
// keeps the digits that 1 - (N.H)^2 loses.
// With both cosines at least COS_MIN, N.h >= 2^-21; and |h| >= N.h, which rounding breaks where L is close to
// -E, so hh is held to it: every divisor below is then at least 2^-42, and the specular lobe finite.
vec3 cook_torrance(vec3 N, vec3 L, vec3 E, float NoL, float NoE, float m2, vec3 f0, float f90) {
    if (NoL < COS_MIN || NoE < COS_MIN) {
        return vec3(0.0);
    }
    vec3 h = L + E;
    vec3 difference = L - E;
    vec3 sine = cross(N, h);
    float Noh = NoL + NoE;
    float Noh2 = Noh * Noh;
    float hh = max(dot(h, h), Noh2);
    float LoH = 0.5 * sqrt(hh);

    float D = D_Beckmann(dot(sine, sine) / Noh2, hh / Noh2, m2);
    vec3 F = F_Schlick(f0, f90, 0.25 * dot(difference, difference) / (1.0 + LoH));
    float G = G_VCavity(NoL, NoE, hh);
    return F * (D * G * 0.25 / NoE);
}
