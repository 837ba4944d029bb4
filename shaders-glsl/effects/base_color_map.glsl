// How does the albedo change from place to place? An effect.

#include "effects/called_for.glsl"
#include "interface/materials.glsl"
#include "maps/sample.glsl"
#include "shading/surface.glsl"

layout(constant_id = 17) const int EFFECT_BASE_COLOR_MAP = -1;
const uint BIT_BASE_COLOR_MAP = 128u;

// sRGB, decoded by the sampler.
layout(set = 0, binding = 8) uniform texture2DArray base_color_maps_small;
layout(set = 0, binding = 9) uniform texture2DArray base_color_maps_medium;
layout(set = 0, binding = 10) uniform texture2DArray base_color_maps_large;

void base_color_map(inout Surface surface, Material material, MapPlace place) {
    if (!called_for(EFFECT_BASE_COLOR_MAP, surface.effects, BIT_BASE_COLOR_MAP)) {
        return;
    }
    surface.albedo *= sample_map(
        base_color_maps_small, base_color_maps_medium, base_color_maps_large, material.base_color_map, place
    ).rgb;
}
