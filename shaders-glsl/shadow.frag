#version 460
// Which texels of a depth map does a surface with holes leave free?

#include "interface/materials.glsl"
#include "maps/derivatives.glsl"
#include "effects/alpha_mask.glsl"

layout(location = 0) in vec2 in_coordinates; // u right, v up
layout(location = 1) flat in uint in_material;

void main() {
    Material material = materials[in_material];
    alpha_mask(material, map_place(in_coordinates, material.map_repeat));
}
