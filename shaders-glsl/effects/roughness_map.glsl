// How does the roughness change from place to place? An effect.

#include "effects/called_for.glsl"
#include "interface/materials.glsl"
#include "maps/numbers.glsl"
#include "shading/surface.glsl"

layout(constant_id = 18) const int EFFECT_ROUGHNESS_MAP = -1;
const uint BIT_ROUGHNESS_MAP = 256u;

void roughness_map(inout Surface surface, Material material, MapPlace place) {
    if (!called_for(EFFECT_ROUGHNESS_MAP, surface.effects, BIT_ROUGHNESS_MAP)) {
        return;
    }
    surface.roughness *= sample_number(material.roughness_map, place);
}
