// How much light arrives from one lamp, and from where?

#include "interface/lights.glsl"

// The most that is counted, far above any lamp (the sun's surface: 6e9 lx): 2^64 lx times the specular lobe's
// largest value (1 / (4 pi M_MIN^2 COS_MIN), 2^39) and a million lights stay finite.
const float ILLUMINANCE_MAX = 1.8446744073709552e19; // 2^64

struct Incident {
    vec3 L;           // unit, to the lamp
    vec3 illuminance; // at normal incidence, lx
    float r2;         // (radius / distance)^2, at most 1
    bool arrives;     // false where the rest means nothing
};

// A lamp so far away that its rays are parallel: what every lamp is unless an effect says otherwise.
Incident parallel_light(Light light) {
    vec3 illuminance = min(light.intensity, vec3(ILLUMINANCE_MAX));
    return Incident(light.position.xyz, illuminance, light.radius * light.radius, true);
}
