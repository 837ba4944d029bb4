// What light of one lamp leaves a point by the slides' listings, and by a mix of tiers?

#include "effects/diffuse_lobe.glsl"
#include "effects/specular_lobe.glsl"
#include "light/incident.glsl"
#include "math/direction.glsl"
#include "shading/surface.glsl"
#include "slides/cook_torrance.glsl"
#include "slides/oren_nayar.glsl"

// The deck scales one Fresnel number; a material has three. The largest channel of f0 is FresnelScale, and f0
// divided by it the colour of the reflection, so that at normal incidence their product is f0.
// The deck leaves the light's factor open: illuminance / pi stands before both listings, and no further cosine.
Lobes slides_light(Surface surface, Incident incident) {
    vec3 radiance = incident.illuminance * INV_PI;
    float FresnelScale = max(max(surface.f0.r, surface.f0.g), surface.f0.b);
    vec3 specular = FresnelScale >= LENGTH_MIN ? surface.f0 / FresnelScale : vec3(1.0);
    float Roughness = surface.roughness;
    return Lobes(
        radiance * surface.albedo * SlidesOrenNayar(surface.N, incident.L, surface.E, Roughness),
        radiance * specular * SlidesCookTorrance(surface.N, incident.L, surface.E, Roughness, FresnelScale)
    );
}

Lobes mixed_light(Surface surface, Incident incident) {
    Lobes lobes = Lobes(vec3(0.0), vec3(0.0));
    diffuse_lobe(lobes, surface, incident);
    specular_lobe(lobes, surface, incident);
    lobes.diffuse *= incident.illuminance;
    lobes.specular *= incident.illuminance;
    return lobes;
}
