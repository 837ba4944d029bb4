// How does a rough base differ from a smooth one? An effect (Oren-Nayar): a smooth base is Lambert's.

#include "brdf/oren_nayar.glsl"
#include "effects/called_for.glsl"
#include "shading/surface.glsl"

layout(constant_id = 10) const int EFFECT_ROUGH_DIFFUSE = -1;
const uint BIT_ROUGH_DIFFUSE = 4u;

void rough_diffuse_weights(inout Surface surface) {
    if (!called_for(EFFECT_ROUGH_DIFFUSE, surface.effects, BIT_ROUGH_DIFFUSE)) {
        return;
    }
    surface.weights = oren_nayar_weights(surface.roughness);
}

// lobe: pi f NoL for albedo 1; at sigma = 0 the model is Lambert's, bit for bit.
void rough_diffuse(inout float lobe, Surface surface, float NoL, float LoE) {
    if (!called_for(EFFECT_ROUGH_DIFFUSE, surface.effects, BIT_ROUGH_DIFFUSE)) {
        return;
    }
    lobe = oren_nayar(surface.weights, NoL, surface.NoE, LoE);
}
