#version 460
// Where does a vertex fall on the screen, and which way does its surface face?

#include "interface/frame.glsl"
#include "interface/instances.glsl"
#include "math/direction.glsl"

layout(location = 0) in vec3 in_position; // object space, m
layout(location = 1) in vec3 in_normal;   // object space, any length

layout(location = 0) out vec3 out_position; // world space, m
layout(location = 1) out vec3 out_normal;   // world space, unit; zero where it has no direction
layout(location = 2) flat out uint out_material;
layout(location = 3) flat out float out_handedness;

// A normal is the cross product of two tangents a and b. The map M takes them to Ma and Mb, and
// Ma x Mb = cof(M) (a x b), where the columns of the cofactor matrix are the cross products of those of M:
// no inverse, so a flattened object (determinant 0) has normals too. cof(M) = det(M) M^-T, and M^-T alone keeps
// a normal on its side of the surface: (M^-T n).(M v) = n.v. So a mirroring map (det(M) < 0) turns cof(M) n
// to the inside, and handedness, the sign of the determinant, turns it out again.
vec3 world_normal(vec3 column_x, vec3 column_y, vec3 column_z, float handedness, vec3 n) {
    vec3 mapped = cross(column_y, column_z) * n.x + cross(column_z, column_x) * n.y + cross(column_x, column_y) * n.z;
    return handedness * direction_or(mapped, vec3(0.0));
}

void main() {
    vec4 x = instances[gl_InstanceIndex].world_x;
    vec4 y = instances[gl_InstanceIndex].world_y;
    vec4 z = instances[gl_InstanceIndex].world_z;
    float handedness = instances[gl_InstanceIndex].handedness;

    vec4 object = vec4(in_position, 1.0);
    vec3 position = vec3(dot(x, object), dot(y, object), dot(z, object));

    gl_Position = frame.view_projection * vec4(position, 1.0);
    out_position = position;
    out_normal = world_normal(vec3(x.x, y.x, z.x), vec3(x.y, y.y, z.y), vec3(x.z, y.z, z.z), handedness, in_normal);
    out_material = instances[gl_InstanceIndex].material;
    out_handedness = handedness;
}
