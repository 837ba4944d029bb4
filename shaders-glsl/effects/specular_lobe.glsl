// What does the interface reflect, and what does it take from the base? An effect: without f0 there is no interface.

#include "brdf/cook_torrance.glsl"
#include "effects/called_for.glsl"
#include "light/hemisphere.glsl"
#include "light/incident.glsl"
#include "shading/surface.glsl"

layout(constant_id = 9) const int EFFECT_SPECULAR_LOBE = -1;
const uint BIT_SPECULAR_LOBE = 2u;

// What the interface lets out of the base, by the angle to the eye. Without the effect it is all.
void specular_interface(inout Surface surface) {
    if (!called_for(EFFECT_SPECULAR_LOBE, surface.effects, BIT_SPECULAR_LOBE)) {
        return;
    }
    surface.f90 = f90_of(surface.f0);
    surface.through = T_Schlick(surface.f0, surface.f90, clamp(surface.NoE, 0.0, 1.0));
}

// The base gets what the interface let in, (1 - F(NoL)), and gives what it lets out, (1 - F(NoE)): reciprocal
// (Ashikhmin and Shirley 2000 weigh the two sides alike), and no more than 1 together with the specular lobe.
void specular_lobe(inout Lobes lobes, Surface surface, Incident incident) {
    if (!called_for(EFFECT_SPECULAR_LOBE, surface.effects, BIT_SPECULAR_LOBE)) {
        return;
    }
    float NoL = dot(surface.N, incident.L);
    lobes.diffuse *= T_Schlick(surface.f0, surface.f90, clamp(NoL, 0.0, 1.0));
    float m2 = beckmann_m2(surface.roughness, incident.r2);
    lobes.specular =
        cook_torrance(surface.N, incident.L, surface.E, NoL, surface.NoE, m2, surface.f0, surface.f90);
}

void specular_ambient(inout Lobes lobes, Surface surface, vec3 sky, vec3 ground) {
    if (!called_for(EFFECT_SPECULAR_LOBE, surface.effects, BIT_SPECULAR_LOBE)) {
        return;
    }
    vec3 F = F_SchlickRough(surface.f0, surface.f90, surface.roughness, surface.NoE);
    float m = max(surface.roughness, M_MIN);
    lobes.specular = F * hemisphere_specular(sky, ground, surface.N, surface.E, surface.NoE, m);
}
