// Where is a surface metal? An effect.

#include "effects/called_for.glsl"
#include "interface/materials.glsl"
#include "maps/numbers.glsl"
#include "shading/surface.glsl"

layout(constant_id = 19) const int EFFECT_METALNESS_MAP = -1;
const uint BIT_METALNESS_MAP = 512u;

// A metal scatters nothing from inside, and reflects in what would be its base colour (Burley 2012, section 5.3).
void metalness_map(inout Surface surface, Material material, MapPlace place) {
    if (!called_for(EFFECT_METALNESS_MAP, surface.effects, BIT_METALNESS_MAP)) {
        return;
    }
    float metalness = material.metalness * sample_number(material.metalness_map, place);
    surface.f0 = mix(surface.f0, surface.albedo, metalness);
    surface.albedo *= 1.0 - metalness;
}
