// Which colour has the reflection? An effect: most stuffs reflect grey, gold and copper do not.

#include "effects/called_for.glsl"
#include "interface/materials.glsl"
#include "shading/surface.glsl"

layout(constant_id = 11) const int EFFECT_COLORED_F0 = -1;
const uint BIT_COLORED_F0 = 8u;

// Without the effect all three channels are the largest one, and a compiler computes one Fresnel number for three.
void colored_f0(inout Surface surface, Material material) {
    if (!called_for(EFFECT_COLORED_F0, surface.effects, BIT_COLORED_F0)) {
        return;
    }
    surface.f0 = material.f0;
}
