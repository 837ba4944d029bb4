#version 460
// Where does a bare triangle stand, and which shade is its? By its number alone: no record is read.

#include "interface/bare.glsl"

layout(location = 0) in vec3 in_position; // in cells

layout(location = 0) flat out uint out_shade;

void main() {
    uint cell = uint(gl_InstanceIndex);
    vec2 place = vec2(float(cell % bare.columns), float(cell / bare.columns)) + in_position.xy;
    vec2 size = vec2(float(bare.columns), float(bare.rows));
    gl_Position = vec4(place / size * 2.0 - 1.0, 0.5, 1.0);
    // Exact below 2^32: the host checks draws times shades.
    out_shade = bare.sorted != 0u ? cell * bare.shades / bare.draws : cell % bare.shades;
}
