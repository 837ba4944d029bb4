// Which depth maps do lamps see the scene through? One record and one layer for each.

struct ShadowMap {
    mat4 clip;   // world to the map's clip space; reversed depth
    mat4 planes; // its inverse, transposed: maps a plane of the world to one of clip space
};

layout(set = 0, binding = 17, std430) readonly buffer ShadowBlock {
    ShadowMap shadow_maps[];
};
