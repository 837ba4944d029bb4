// How does a rough base differ from a smooth one? An effect, by the pipeline's diffuse tier: a smooth base is Lambert's.

#include "brdf/eon.glsl"
#include "brdf/full_oren_nayar.glsl"
#include "brdf/fujii.glsl"
#include "brdf/oren_nayar.glsl"
#include "effects/called_for.glsl"
#include "interface/variants.glsl"
#include "shading/surface.glsl"
#include "slides/oren_nayar.glsl"

layout(constant_id = 10) const int EFFECT_ROUGH_DIFFUSE = -1;
const uint BIT_ROUGH_DIFFUSE = 4u;

void rough_diffuse_weights(inout Surface surface) {
    if (!called_for(EFFECT_ROUGH_DIFFUSE, surface.effects, BIT_ROUGH_DIFFUSE)) {
        return;
    }
    if (DIFFUSE == DIFFUSE_QON) {
        surface.weights = oren_nayar_weights(surface.roughness);
    }
    if (DIFFUSE == DIFFUSE_FON || DIFFUSE == DIFFUSE_EON) {
        surface.weights = fujii_weights(surface.roughness);
    }
}

// At roughness 0 every tier is Lambert's; oren_nayar is so bit for bit.
void rough_diffuse(inout Base base, Surface surface, float NoL, vec3 L) {
    if (!called_for(EFFECT_ROUGH_DIFFUSE, surface.effects, BIT_ROUGH_DIFFUSE)) {
        return;
    }
    float LoE = dot(L, surface.E);
    if (DIFFUSE == DIFFUSE_SLIDES) {
        base.lobe = SlidesOrenNayar(surface.N, L, surface.E, surface.roughness);
    }
    if (DIFFUSE == DIFFUSE_QON) {
        base.lobe = oren_nayar(surface.weights, NoL, surface.NoE, LoE);
    }
    if (DIFFUSE == DIFFUSE_FON || DIFFUSE == DIFFUSE_EON) {
        base.lobe = fujii(surface.weights, NoL, surface.NoE, LoE);
    }
    if (DIFFUSE == DIFFUSE_EON) {
        base.rest = eon_bounced(surface.albedo, surface.roughness, surface.weights, NoL, surface.NoE);
    }
    if (DIFFUSE == DIFFUSE_FULL_OREN_NAYAR) {
        float triple = dot(surface.N, cross(L, surface.E));
        float s = LoE - NoL * surface.NoE;
        FullOrenNayar lobe = full_oren_nayar_lobe(surface.roughness, NoL, surface.NoE, s, triple);
        base = Base(0.0, full_oren_nayar(lobe, surface.albedo));
    }
}
