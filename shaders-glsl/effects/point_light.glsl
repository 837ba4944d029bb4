// What changes where a lamp stands in the scene? An effect: its light comes from there, and thins out.

#include "effects/called_for.glsl"
#include "interface/lights.glsl"
#include "light/incident.glsl"

layout(constant_id = 15) const int EFFECT_POINT_LIGHT = -1;
const uint BIT_POINT_LIGHT = 1u;

// A lamp nearer than 2^-50 m (1e-15 m) is on the surface point itself, has no direction, and gives nothing.
// Squares of components that a device flushes to zero (below 2^-126) are then under 2^-24 of the sum.
const float DISTANCE2_MIN = 7.888609052210118e-31; // 2^-100
// Beyond 2^63 m the square leaves the divisors that Vulkan defines; 1000 light years: nothing arrives.
const float DISTANCE2_MAX = 8.507059173023462e37;  // 2^126
// Keeps the cap below 2^124; so far away nothing comes near it.
const float CAPPED2_MAX = 1.152921504606847e18; // 2^60

// Inside the lamp's own sphere the illuminance stops growing.
void point_light(inout Incident incident, Light light, vec3 point) {
    if (!called_for(EFFECT_POINT_LIGHT, light.effects, BIT_POINT_LIGHT)) {
        return;
    }
    vec3 d = light.position.xyz - point;
    float distance2 = dot(d, d);
    bool reached = distance2 >= DISTANCE2_MIN && distance2 <= DISTANCE2_MAX;
    distance2 = reached ? distance2 : 1.0;

    float radius2 = light.radius * light.radius;
    float nearest2 = max(distance2, radius2);
    // The cap stands before the division, whose result could be infinite.
    vec3 most = vec3(ILLUMINANCE_MAX * min(nearest2, CAPPED2_MAX));
    vec3 illuminance = min(light.intensity, most) / nearest2;
    incident = Incident(d * inversesqrt(distance2), illuminance, radius2 / nearest2, reached);
}
