// How does the light given off change from place to place? An effect.

#include "effects/called_for.glsl"
#include "interface/materials.glsl"
#include "maps/sample.glsl"
#include "shading/surface.glsl"

layout(constant_id = 21) const int EFFECT_EMISSION_MAP = -1;
const uint BIT_EMISSION_MAP = 2048u;

// Linear, with a shared exponent: HDR pictures keep their range.
layout(set = 0, binding = 14) uniform texture2DArray emission_maps_small;
layout(set = 0, binding = 15) uniform texture2DArray emission_maps_medium;
layout(set = 0, binding = 16) uniform texture2DArray emission_maps_large;

void emission_map(inout Surface surface, Material material, MapPlace place) {
    if (!called_for(EFFECT_EMISSION_MAP, surface.effects, BIT_EMISSION_MAP)) {
        return;
    }
    surface.emission *= sample_map(
        emission_maps_small, emission_maps_medium, emission_maps_large, material.emission_map, place
    ).rgb;
}
