// How do the matte base and the interface above it share the light?

#include "math/constants.glsl"
#include "brdf/oren_nayar.glsl"
#include "brdf/schlick.glsl"
#include "brdf/cook_torrance.glsl"
#include "light/hemisphere.glsl"

// What one light, or the surroundings, send to the eye, cd/m^2. The base is dimmed by opacity, the interface not.
struct Lobes {
    vec3 diffuse;
    vec3 specular;
};

// All that does not depend on the light, computed once per surface point.
struct CoupledSurface {
    vec3 N; // unit, towards the eye's side
    vec3 E; // unit, to the eye
    float NoE;
    float m;
    vec3 f0;
    float f90;
    vec3 F;    // reflectance of the interface towards the eye
    vec3 base; // albedo times what the interface lets out towards the eye
    OrenNayarWeights weights;
};

// roughness is clamped to 0..1: both sigma (radians) and m.
CoupledSurface coupled_surface(vec3 N, vec3 E, vec3 albedo, vec3 f0, float roughness) {
    float m = clamp(roughness, 0.0, 1.0);
    float NoE = dot(N, E);
    float f90 = f90_of(f0);
    vec3 F = F_Schlick(f0, f90, 1.0 - clamp(NoE, 0.0, 1.0));
    return CoupledSurface(N, E, NoE, m, f0, f90, F, albedo * (1.0 - F), oren_nayar_weights(m));
}

// Radiance for irradiance 1 at normal incidence, from the direction L (unit); r2: see beckmann_m2.
// The base gets what the interface let in, (1 - F(NoL)), and gives what it lets out, (1 - F(NoE)): reciprocal
// (Ashikhmin and Shirley 2000 weigh the two sides alike), and no more than 1 together with the specular lobe.
Lobes coupled(CoupledSurface surface, vec3 L, float r2) {
    float NoL = dot(surface.N, L);
    float LoE = dot(L, surface.E);
    float lobe = oren_nayar(surface.weights, NoL, surface.NoE, LoE) * INV_PI;
    vec3 entering = 1.0 - F_Schlick(surface.f0, surface.f90, 1.0 - clamp(NoL, 0.0, 1.0));
    float m2 = beckmann_m2(surface.m, r2);
    return Lobes(
        surface.base * entering * lobe,
        cook_torrance(surface.N, L, surface.E, NoL, surface.NoE, m2, surface.f0, surface.f90)
    );
}

// Radiance under a sky and a ground: the base gives what the interface lets out, the interface its own share.
Lobes coupled_ambient(CoupledSurface surface, vec3 sky, vec3 ground) {
    vec3 F = F_SchlickRough(surface.f0, surface.f90, surface.m, surface.NoE);
    float m = max(surface.m, M_MIN);
    return Lobes(
        surface.base * hemisphere_diffuse(sky, ground, surface.N),
        F * hemisphere_specular(sky, ground, surface.N, surface.E, surface.NoE, m)
    );
}
