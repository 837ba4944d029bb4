#version 460
// Which shade has a bare triangle, if that is told by its number, a push constant, a set or the pipeline?

#include "interface/bare.glsl"

layout(location = 0) flat in uint in_shade;

layout(location = 0) out vec4 out_colour;

layout(constant_id = 48) const int BARE_SOURCE = 0; // one of the BARE_ values
layout(constant_id = 49) const int BARE_SHADE = 0;  // where the pipeline tells it

const int BARE_NUMBER = 0;
const int BARE_PUSHED = 1;
const int BARE_BOUND = 2;
const int BARE_COMPILED = 3;

layout(push_constant) uniform BarePushBlock {
    uint bare_pushed;
};

layout(set = 1, binding = 0, std140) uniform OwnShadeBlock {
    uint own_shade;
};

void main() {
    uint shade = in_shade;
    if (BARE_SOURCE == BARE_PUSHED) {
        shade = bare_pushed;
    }
    if (BARE_SOURCE == BARE_BOUND) {
        shade = own_shade;
    }
    if (BARE_SOURCE == BARE_COMPILED) {
        shade = uint(BARE_SHADE);
    }
    float grey = float(shade + 1u) / float(bare.shades);
    out_colour = vec4(grey, grey, grey, 1.0);
}
