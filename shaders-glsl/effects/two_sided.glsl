// What is seen of a face from behind? An effect: without it back faces are dropped.

#include "effects/called_for.glsl"
#include "math/direction.glsl"
#include "shading/surface.glsl"

layout(constant_id = 14) const int EFFECT_TWO_SIDED = -1;
const uint BIT_TWO_SIDED = 64u;

// A face seen from behind turns its normal. A mirroring map turns the winding too, so handedness (-1 there) decides with
// front_facing which side is the front. A normal without direction faces the eye, from either side.
void two_sided(inout Surface surface, vec3 normal, float handedness, bool front_facing) {
    if (!called_for(EFFECT_TWO_SIDED, surface.effects, BIT_TWO_SIDED)) {
        return;
    }
    surface.side = front_facing ? handedness : -handedness;
    surface.N = surface.side * direction_or(normal, surface.side * surface.E);
}
