// Which lights shine? One record serves directional, point and spot lights.

struct Light {
    vec4 position;      // w = 1: position, m; w = 0: unit direction to the light
    vec3 intensity;     // w = 1: luminous intensity, cd; w = 0: illuminance facing it, lx
    float radius;       // w = 1: radius, m; w = 0: tangent of the angular radius; > 0
    vec3 axis;          // unit direction of a spot's beam
    float cone_scale;   // falloff = clamp(cos * scale + offset, 0, 1)^2; a point light has 0, 1
    float cone_offset;
    float light_padding_0;
    float light_padding_1;
    float light_padding_2;
};

layout(set = 0, binding = 3, std430) readonly buffer LightBlock {
    Light lights[];
};
