#version 460
// What does a surface look like whose material is bound before its draw, as a set or a window of its own? For the benchmark.

#include "interface/own_material.glsl"

Material material_of_draw(uint number, vec2 coordinates) {
    return own_material;
}

#include "shading/fragment.glsl"
