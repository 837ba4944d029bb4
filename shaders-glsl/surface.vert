#version 460
// Where does a vertex fall on the screen, and which way does its surface face?

#include "interface/frame.glsl"
#include "interface/instances.glsl"
#include "math/direction.glsl"
#include "effects/normal_map.glsl"

layout(location = 0) in vec3 in_position;    // object space, m
layout(location = 1) in vec3 in_normal;      // object space, any length
layout(location = 2) in vec2 in_coordinates; // u right, v up
layout(location = 3) in vec4 in_tangent;     // object space, unit; w: the bitangent is w (normal x tangent)

layout(location = 0) out vec3 out_position; // world space, m
layout(location = 1) out vec3 out_normal;   // world space, unit; zero where it has no direction
layout(location = 2) flat out uint out_material;
layout(location = 3) flat out float out_handedness;
layout(location = 4) out vec2 out_coordinates;
layout(location = 5) out vec4 out_tangent; // world space, unit or zero; w as above

// A normal is the cross product of two tangents a and b. The map M takes them to Ma and Mb, and
// Ma x Mb = cof(M) (a x b), where the columns of the cofactor matrix are the cross products of those of M:
// no inverse, so a flattened object (determinant 0) has normals too. cof(M) = det(M) M^-T, and M^-T alone keeps
// a normal on its side of the surface: (M^-T n).(M v) = n.v. So a mirroring map (det(M) < 0) turns cof(M) n
// to the inside, and handedness, the sign of the determinant, turns it out again.
vec3 world_normal(mat3 M, float handedness, vec3 n) {
    vec3 mapped = cross(M[1], M[2]) * n.x + cross(M[2], M[0]) * n.y + cross(M[0], M[1]) * n.z;
    return handedness * direction_or(mapped, vec3(0.0));
}

void main() {
    vec4 x = instances[gl_InstanceIndex].world_x;
    vec4 y = instances[gl_InstanceIndex].world_y;
    vec4 z = instances[gl_InstanceIndex].world_z;
    float handedness = instances[gl_InstanceIndex].handedness;

    vec4 object = vec4(in_position, 1.0);
    vec3 position = vec3(dot(x, object), dot(y, object), dot(z, object));
    mat3 object_to_world = mat3(vec3(x.x, y.x, z.x), vec3(x.y, y.y, z.y), vec3(x.z, y.z, z.z));
    vec4 tangent = vec4(0.0);
    normal_map_tangent(tangent, in_tangent, object_to_world, handedness);

    gl_Position = frame.view_projection * vec4(position, 1.0);
    out_position = position;
    out_normal = world_normal(object_to_world, handedness, in_normal);
    out_material = instances[gl_InstanceIndex].material;
    out_handedness = handedness;
    out_coordinates = in_coordinates;
    out_tangent = tangent;
}
