// What light does a surface give off? An effect.

#include "effects/called_for.glsl"
#include "shading/surface.glsl"

layout(constant_id = 12) const int EFFECT_EMISSION = -1;
const uint BIT_EMISSION = 16u;

void emission(inout vec3 radiance, Surface surface) {
    if (!called_for(EFFECT_EMISSION, surface.effects, BIT_EMISSION)) {
        return;
    }
    radiance += surface.emission;
}
