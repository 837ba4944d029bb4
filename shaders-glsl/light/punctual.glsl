// How much light arrives from one lamp, and from where?

// A lamp nearer than 2^-50 m (1e-15 m) is on the surface point itself, has no direction, and gives nothing.
// Squares of components that a device flushes to zero (below 2^-126) are then under 2^-24 of the sum.
const float DISTANCE2_MIN = 7.888609052210118e-31; // 2^-100
// Beyond 2^63 m the square leaves the divisors that Vulkan defines; 1000 light years: nothing arrives.
const float DISTANCE2_MAX = 8.507059173023462e37;  // 2^126
// The most that is counted, far above any lamp (the sun's surface: 6e9 lx): 2^64 lx times the specular lobe's
// largest value (1 / (4 pi M_MIN^2 COS_MIN), 2^39) and a million lights stay finite.
const float ILLUMINANCE_MAX = 1.8446744073709552e19; // 2^64

// Keeps the cap below 2^124; so far away nothing comes near it.
const float CAPPED2_MAX = 1.152921504606847e18; // 2^60

struct Incident {
    vec3 L;           // unit, to the lamp
    vec3 illuminance; // at normal incidence, lx
    float r2;         // (radius / distance)^2, at most 1
};

// Lamp at `position` (w = 1) or in that unit direction (w = 0); the other numbers: see the record `Light`.
// Inside the lamp's own sphere the illuminance stops growing. The cone's form: Lagarde and de Rousiers 2014, listing 4.
// False where nothing arrives; `incident` then is not to be used.
bool incident_from(
    vec4 position, vec3 intensity, float radius, vec3 axis, float cone_scale, float cone_offset, vec3 point,
    out Incident incident
) {
    vec3 d = position.xyz - position.w * point;
    float distance2 = dot(d, d);
    bool reached = distance2 >= DISTANCE2_MIN && distance2 <= DISTANCE2_MAX;
    distance2 = reached ? distance2 : 1.0;

    vec3 L = d * inversesqrt(distance2);
    float cone = clamp(cone_scale * -dot(axis, L) + cone_offset, 0.0, 1.0);
    float radius2 = radius * radius;
    float nearest2 = max(distance2, radius2);
    // The cap stands before the division, whose result could be infinite.
    vec3 most = vec3(ILLUMINANCE_MAX * min(nearest2, CAPPED2_MAX));
    vec3 illuminance = min(intensity * (cone * cone), most) / nearest2;
    incident = Incident(L, illuminance, radius2 / nearest2);
    return reached && cone > 0.0;
}
