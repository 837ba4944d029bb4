// How much of what lies behind is seen? An effect.

#include "effects/called_for.glsl"
#include "interface/materials.glsl"
#include "interface/variants.glsl"
#include "shading/surface.glsl"

layout(constant_id = 13) const int EFFECT_TRANSPARENCY = -1;
const uint BIT_TRANSPARENCY = 32u;

// The base is dimmed by opacity, the interface is not. The interface of a mix hides what it reflects away, so it covers
// even where the base is clear.
void transparency(inout Lobes sum, inout float alpha, Surface surface, Material material) {
    if (!called_for(EFFECT_TRANSPARENCY, surface.effects, BIT_TRANSPARENCY)) {
        return;
    }
    sum.diffuse *= material.opacity;
    alpha = material.opacity;
    if (LIGHTING == LIGHTING_MIXED) {
        float through = min(min(surface.through.r, surface.through.g), surface.through.b);
        alpha = 1.0 - (1.0 - alpha) * through;
    }
}
