// How does a lamp with a beam shine? An effect.

#include "effects/called_for.glsl"
#include "interface/lights.glsl"
#include "light/incident.glsl"

layout(constant_id = 16) const int EFFECT_SPOT_LIGHT = -1;
const uint BIT_SPOT_LIGHT = 2u;

// The cone's form: Lagarde and de Rousiers 2014, listing 4.
void spot_light(inout Incident incident, Light light) {
    if (!called_for(EFFECT_SPOT_LIGHT, light.effects, BIT_SPOT_LIGHT)) {
        return;
    }
    float cone = clamp(light.cone_scale * -dot(light.axis, incident.L) + light.cone_offset, 0.0, 1.0);
    incident.illuminance *= cone * cone;
    incident.arrives = incident.arrives && cone > 0.0;
}
