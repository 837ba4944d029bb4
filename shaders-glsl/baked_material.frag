#version 460
// What does a surface look like whose material is compiled into its pipeline? For the benchmark.

#include "shading/baked_material.glsl"

Material material_of_draw(uint number, vec2 coordinates) {
    return baked_material(materials[number]);
}

#include "shading/fragment.glsl"
