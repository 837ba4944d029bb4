// Which lights shine? One record serves directional, point and spot lights.

struct Light {
    vec4 position;      // point, spot: position, m; directional: unit direction to the light
    vec3 intensity;     // point, spot: luminous intensity, cd; directional: illuminance facing it, lx
    float radius;       // point, spot: radius, m; directional: tangent of the angular radius; > 0
    vec3 axis;          // unit direction of a spot's beam
    float cone_scale;   // a spot's falloff = clamp(cos * scale + offset, 0, 1)^2
    float cone_offset;
    uint effects;       // bits of the effects that this light calls for
    uint shadow_first;  // its first shadow map
    uint shadow_count;  // its shadow maps: 1, or 6 for the faces of a cube
};

layout(set = 0, binding = 3, std430) readonly buffer LightBlock {
    Light lights[];
};
