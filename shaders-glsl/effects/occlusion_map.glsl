// Which hollows see less of their surroundings? An effect.

#include "effects/called_for.glsl"
#include "interface/materials.glsl"
#include "maps/numbers.glsl"
#include "shading/surface.glsl"

layout(constant_id = 22) const int EFFECT_OCCLUSION_MAP = -1;
const uint BIT_OCCLUSION_MAP = 4096u;

// Dims what comes from all around, and not what comes from lamps.
void occlusion_map(inout Lobes ambient, Surface surface, Material material, MapPlace place) {
    if (!called_for(EFFECT_OCCLUSION_MAP, surface.effects, BIT_OCCLUSION_MAP)) {
        return;
    }
    float open = sample_number(material.occlusion_map, place);
    ambient.diffuse *= open;
    ambient.specular *= open;
}
