// Where does a drawn object stand, and what is it made of? Found by gl_InstanceIndex.

struct Instance {
    vec4 world_x;    // the three rows of object-to-world, an affine map
    vec4 world_y;
    vec4 world_z;
    uint material;   // index into `materials`
    float handedness; // -1 where the map mirrors, so that faces keep their front; else 1
    uint instance_padding_0;
    uint instance_padding_1;
};

layout(set = 0, binding = 1, std430) readonly buffer InstanceBlock {
    Instance instances[];
};
