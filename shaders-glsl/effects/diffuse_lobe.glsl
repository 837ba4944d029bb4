// What does the matte base scatter? An effect: a pure metal has no base.

#include "effects/called_for.glsl"
#include "effects/rough_diffuse.glsl"
#include "light/hemisphere.glsl"
#include "light/incident.glsl"
#include "math/constants.glsl"
#include "shading/surface.glsl"

layout(constant_id = 8) const int EFFECT_DIFFUSE_LOBE = -1;
const uint BIT_DIFFUSE_LOBE = 1u;

// What a lamp's light leaves through an interface that is not there yet: Lambert 1760, unless the base is rough.
void diffuse_lobe(inout Lobes lobes, Surface surface, Incident incident) {
    if (!called_for(EFFECT_DIFFUSE_LOBE, surface.effects, BIT_DIFFUSE_LOBE)) {
        return;
    }
    float NoL = dot(surface.N, incident.L);
    float lobe = NoL < COS_MIN ? 0.0 : NoL;
    rough_diffuse(lobe, surface, NoL, dot(incident.L, surface.E));
    lobes.diffuse = surface.albedo * surface.through * (lobe * INV_PI);
}

void diffuse_ambient(inout Lobes lobes, Surface surface, vec3 sky, vec3 ground) {
    if (!called_for(EFFECT_DIFFUSE_LOBE, surface.effects, BIT_DIFFUSE_LOBE)) {
        return;
    }
    lobes.diffuse = surface.albedo * surface.through * hemisphere_diffuse(sky, ground, surface.N);
}
