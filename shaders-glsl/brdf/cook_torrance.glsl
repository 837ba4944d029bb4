// How do facets that are small mirrors reflect? Cook and Torrance 1982, rightly normalised.

#include "brdf/beckmann.glsl"
#include "brdf/schlick.glsl"
#include "brdf/v_cavity.glsl"
#include "math/constants.glsl"
#include "math/half_vector.glsl"

// f NoL / F = D G / (4 NoE), with D normalised; NoL = N.L and NoE = N.E at least COS_MIN; m2 of beckmann_m2. As D / (hh NoE) times
// G hh / 4: finite, as both are. Errs as D_Beckmann does.
float cook_torrance_facets(HalfVector h, float NoL, float NoE, float m2) {
    float D_over = D_Beckmann_over_hh(h.sine2, h.Noh * h.Noh, h.hh, m2, NoE);
    return D_over * G_EoH2_VCavity(NoL, NoE, h.hh);
}

// f NoL with Schlick's F; 0 for a light or an eye at or below the surface.
vec3 cook_torrance_lobe(HalfVector h, float NoL, float NoE, float m2, vec3 f0, float f90) {
    bool lit = NoL >= COS_MIN && NoE >= COS_MIN;
    float facets = lit ? cook_torrance_facets(h, NoL, NoE, m2) : 0.0;
    return F_Schlick(f0, f90, half_rest(h)) * facets;
}

// The same for unit vectors N, L, E.
vec3 cook_torrance(vec3 N, vec3 L, vec3 E, float NoL, float NoE, float m2, vec3 f0, float f90) {
    return cook_torrance_lobe(half_vector(N, L, E, NoL, NoE), NoL, NoE, m2, f0, f90);
}
