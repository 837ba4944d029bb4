// How large is a pixel on a map? For fragment shaders only.

#include "maps/place.glsl"

// coordinates: u right, v up, as models have them. To be called before any branch: a derivative inside one is undefined.
// Only what is interpolated is differentiated: the pixels that a driver adds beyond a triangle's edge to complete a quad
// need not see what buffers hold (lavapipe shows them zeros).
MapPlace map_place(vec2 coordinates, vec2 repeat) {
    vec2 scale = vec2(repeat.x, -repeat.y);
    return MapPlace(coordinates * scale, dFdx(coordinates) * scale, dFdy(coordinates) * scale);
}
