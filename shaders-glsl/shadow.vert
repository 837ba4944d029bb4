#version 460
// Where does a vertex fall on a lamp's depth map?

#include "interface/frame.glsl"
#include "interface/instances.glsl"
#include "interface/shadow_maps.glsl"

layout(location = 0) in vec3 in_position;    // object space, m
layout(location = 2) in vec2 in_coordinates; // u right, v up

layout(location = 0) out vec2 out_coordinates;
layout(location = 1) flat out uint out_material;

// No state command stands between two draws: the instance tells the object and, by whole rounds of all objects, the map.
void main() {
    uint map = uint(gl_InstanceIndex) / frame.object_count;
    uint number = uint(gl_InstanceIndex) % frame.object_count;
    vec4 object = vec4(in_position, 1.0);
    vec3 position = vec3(
        dot(instances[number].world_x, object),
        dot(instances[number].world_y, object),
        dot(instances[number].world_z, object)
    );
    gl_Position = shadow_maps[map].clip * vec4(position, 1.0);
    out_coordinates = in_coordinates;
    out_material = instances[number].material;
}
