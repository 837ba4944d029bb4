#version 460
// What does a surface look like whose pipeline holds its finish, and whose set holds its colours? For the benchmark.

#include "interface/own_material.glsl"
#include "shading/baked_material.glsl"

Material material_of_draw(uint number, vec2 coordinates) {
    Material material = baked_material(own_material);
    material.albedo = own_material.albedo;
    material.emission = own_material.emission;
    return material;
}

#include "shading/fragment.glsl"
