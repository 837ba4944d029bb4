// Where is there no surface, as in leaves and lace? An effect.

#include "effects/called_for.glsl"
#include "interface/materials.glsl"
#include "maps/numbers.glsl"

layout(constant_id = 23) const int EFFECT_ALPHA_MASK = -1;
const uint BIT_ALPHA_MASK = 8192u;

void alpha_mask(Material material, MapPlace place) {
    if (!called_for(EFFECT_ALPHA_MASK, material.effects, BIT_ALPHA_MASK)) {
        return;
    }
    if (sample_number(material.alpha_mask, place) < material.alpha_cutoff) {
        discard;
    }
}
