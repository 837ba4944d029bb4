#version 460
// What does a surface look like whose material is found by the number in its object's record?

#include "interface/materials.glsl"

Material material_of_draw(uint number, vec2 coordinates) {
    return materials[number];
}

#include "shading/fragment.glsl"
