// Which relief is not in the triangles? An effect.

#include "effects/called_for.glsl"
#include "interface/materials.glsl"
#include "maps/sample.glsl"
#include "math/direction.glsl"
#include "shading/surface.glsl"

layout(constant_id = 20) const int EFFECT_NORMAL_MAP = -1;
const uint BIT_NORMAL_MAP = 1024u;

// x and y of the unit normal in tangent space, -1..1; z is what is left.
layout(set = 0, binding = 11) uniform texture2DArray normal_maps_small;
layout(set = 0, binding = 12) uniform texture2DArray normal_maps_medium;
layout(set = 0, binding = 13) uniform texture2DArray normal_maps_large;

// normal and tangent as interpolated, not normalised: MikkTSpace's rule, which the bakers of such maps share. The
// bitangent is tangent.w (normal x tangent), along growing v. What is a bump from the front is a dent from behind.
void normal_map(inout Surface surface, Material material, MapPlace place, vec3 normal, vec4 tangent) {
    if (!called_for(EFFECT_NORMAL_MAP, surface.effects, BIT_NORMAL_MAP)) {
        return;
    }
    vec2 xy = sample_map(
        normal_maps_small, normal_maps_medium, normal_maps_large, material.normal_map, place
    ).xy;
    // A mean of unit vectors is shorter than they are: z is too large then, never imaginary.
    float z = sqrt(max(1.0 - dot(xy, xy), 0.0));
    vec3 bitangent = tangent.w * cross(normal, tangent.xyz);
    vec3 bent = material.normal_scale * (xy.x * tangent.xyz + xy.y * bitangent) + z * normal;
    surface.N = surface.side * direction_or(bent, surface.side * surface.N);
}

// To world space with the object: columns of its map, and the map's handedness.
void normal_map_tangent(inout vec4 world, vec4 tangent, mat3 object_to_world, float handedness) {
    if (EFFECT_NORMAL_MAP == 0) {
        return;
    }
    world = vec4(direction_or(object_to_world * tangent.xyz, vec3(0.0)), handedness * tangent.w);
}
