// What does the interface reflect, and what does it take from the base? An effect: without f0 there is no interface.

#include "effects/called_for.glsl"
#include "light/hemisphere.glsl"
#include "light/incident.glsl"
#include "shading/between_facets.glsl"
#include "shading/facets.glsl"
#include "shading/fresnel.glsl"
#include "shading/surface.glsl"
#include "slides/cook_torrance.glsl"

layout(constant_id = 9) const int EFFECT_SPECULAR_LOBE = -1;
const uint BIT_SPECULAR_LOBE = 2u;

// What the interface lets out of the base, by the angle to the eye. Without the effect it is all.
void specular_interface(inout Surface surface) {
    if (!called_for(EFFECT_SPECULAR_LOBE, surface.effects, BIT_SPECULAR_LOBE)) {
        return;
    }
    surface.f90 = f90_of(surface.f0);
    surface.through = T_interface(surface, clamp(surface.NoE, 0.0, 1.0));
    missing_of(surface);
}

// The listing, its own Fresnel term included. Its factor before the light is illuminance / pi.
vec3 slides_specular(Surface surface, vec3 L) {
    float FresnelScale = max(max(surface.f0.r, surface.f0.g), surface.f0.b);
    float lobe = SlidesCookTorrance(surface.N, L, surface.E, surface.roughness, FresnelScale);
    return scale_colour(surface.f0) * (lobe * INV_PI);
}

// The base gets what the interface let in, (1 - F(NoL)), and gives what it lets out, (1 - F(NoE)): reciprocal
// (Ashikhmin and Shirley 2000 weigh the two sides alike), and no more than 1 together with the specular lobe.
void specular_lobe(inout Lobes lobes, Surface surface, Incident incident) {
    if (!called_for(EFFECT_SPECULAR_LOBE, surface.effects, BIT_SPECULAR_LOBE)) {
        return;
    }
    float NoL = dot(surface.N, incident.L);
    lobes.diffuse *= T_interface(surface, clamp(NoL, 0.0, 1.0));
    if (SPECULAR == SPECULAR_SLIDES) {
        lobes.specular = slides_specular(surface, incident.L);
        return;
    }
    if (NoL < COS_MIN || surface.NoE < COS_MIN) {
        return;
    }
    HalfVector h = half_vector(surface.N, incident.L, surface.E, NoL, surface.NoE);
    float m2 = beckmann_m2(surface.roughness, incident.r2);
    vec3 F = F_interface(surface, half_cosine(h), half_rest(h));
    lobes.specular = F * facets(h, NoL, surface.NoE, m2);
    if (SPECULAR == SPECULAR_GGX_MULTI) {
        lobes.specular += between_facets(surface, NoL);
    }
}

void specular_ambient(inout Lobes lobes, Surface surface, vec3 sky, vec3 ground) {
    if (!called_for(EFFECT_SPECULAR_LOBE, surface.effects, BIT_SPECULAR_LOBE)) {
        return;
    }
    vec3 F = F_SchlickRough(surface.f0, surface.f90, surface.roughness, surface.NoE);
    float m = max(surface.roughness, M_MIN);
    lobes.specular = F * hemisphere_specular(sky, ground, surface.N, surface.E, surface.NoE, m);
}
