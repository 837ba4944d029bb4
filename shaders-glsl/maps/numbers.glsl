// What does a map of plain numbers hold at a place? Roughness, metalness, occlusion and alpha masks share their arrays.

#include "maps/sample.glsl"

layout(set = 0, binding = 5) uniform texture2DArray number_maps_small;
layout(set = 0, binding = 6) uniform texture2DArray number_maps_medium;
layout(set = 0, binding = 7) uniform texture2DArray number_maps_large;

// 0..1, linear.
float sample_number(uint handle, MapPlace place) {
    return sample_map(number_maps_small, number_maps_medium, number_maps_large, handle, place).r;
}
