#version 460
// What does a surface look like whose picture is bound before its draw, as an image and a set of its own? For the benchmark.

#include "interface/materials.glsl"
#include "maps/derivatives.glsl"
#include "maps/sample.glsl"

layout(set = 1, binding = 0) uniform texture2DArray own_picture;

Material material_of_draw(uint number, vec2 coordinates) {
    Material material = materials[number];
    MapPlace place = map_place(coordinates, material.map_repeat);
    vec3 at = vec3(place.uv, 0.0);
    material.albedo *= textureGrad(sampler2DArray(own_picture, map_sampler), at, place.dx, place.dy).rgb;
    return material;
}

#include "shading/fragment.glsl"
