// What does the matte base scatter? An effect: a pure metal has no base.

#include "brdf/lambert.glsl"
#include "effects/called_for.glsl"
#include "effects/rough_diffuse.glsl"
#include "light/hemisphere.glsl"
#include "interface/variants.glsl"
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
    Base base = Base(lambert(NoL), vec3(0.0));
    rough_diffuse(base, surface, NoL, incident.L);
    lobes.diffuse = surface.albedo * surface.through * (base.lobe * INV_PI);
    if (DIFFUSE == DIFFUSE_EON || DIFFUSE == DIFFUSE_FULL_OREN_NAYAR) {
        lobes.diffuse += base.rest * surface.through * INV_PI;
    }
}

void diffuse_ambient(inout Lobes lobes, Surface surface, vec3 sky, vec3 ground) {
    if (!called_for(EFFECT_DIFFUSE_LOBE, surface.effects, BIT_DIFFUSE_LOBE)) {
        return;
    }
    lobes.diffuse = surface.albedo * surface.through * hemisphere_diffuse(sky, ground, surface.N);
}
