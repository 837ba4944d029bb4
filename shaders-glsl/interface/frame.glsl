// What does one frame tell every shader?

struct Frame {
    mat4 view_projection; // world to clip; reversed depth: 1 near, 0 far
    vec4 eye;             // w = 1: eye's position; w = 0: unit direction to it (orthographic)
    vec3 sky;             // radiance of the upper hemisphere (+y), cd/m^2
    uint light_count;     // entries in use of `lights`
    vec3 ground;          // radiance of the lower hemisphere, cd/m^2
    uint object_count;    // entries in use of `instances`
};

layout(set = 0, binding = 0, std140) uniform FrameBlock {
    Frame frame;
};
