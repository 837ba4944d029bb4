#version 460
// What does a surface look like whose material's number is pushed before its draw? For the benchmark.

#include "interface/materials.glsl"

layout(push_constant) uniform PushBlock {
    uint pushed_material; // index into `materials`
};

Material material_of_draw(uint number, vec2 coordinates) {
    return materials[pushed_material];
}

#include "shading/fragment.glsl"
