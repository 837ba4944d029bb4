// What does a map hold at a place? Maps of one format lie in up to three arrays, one for each size class.

#include "maps/place.glsl"

layout(set = 0, binding = 4) uniform sampler map_sampler; // trilinear, repeating

// The size classes that the scene's maps have; with one, nothing is asked. A driver may sample all that it could need.
layout(constant_id = 26) const int MAP_CLASSES = 3;

// A handle is the size class (bits 30 and 31) and the layer (the rest).
const uint MAP_CLASS_SHIFT = 30u;
const uint MAP_LAYER_MASK = 1073741823u;

vec4 sample_map(texture2DArray small, texture2DArray medium, texture2DArray large, uint handle, MapPlace place) {
    uint size_class = handle >> MAP_CLASS_SHIFT;
    vec3 at = vec3(place.uv, float(handle & MAP_LAYER_MASK));
    if (MAP_CLASSES == 1 || size_class == 0u) {
        return textureGrad(sampler2DArray(small, map_sampler), at, place.dx, place.dy);
    }
    if (MAP_CLASSES == 2 || size_class == 1u) {
        return textureGrad(sampler2DArray(medium, map_sampler), at, place.dx, place.dy);
    }
    return textureGrad(sampler2DArray(large, map_sampler), at, place.dx, place.dy);
}
