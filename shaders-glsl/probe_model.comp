#version 460
// What does a whole model say, value by value: one lamp of 1 lx without extent on a point of a frame?

#include "effects/rough_diffuse.glsl"
#include "interface/probe.glsl"
#include "probe/constants.glsl"
#include "shading/models.glsl"

// The point as a frame has it. What differs from material to material comes from the input, so that nothing is folded away.
Surface probed_surface(ProbeInput p) {
    Surface surface;
    surface.effects = 0xffffffffu;
    surface.position = vec3(0.0);
    surface.facet = p.normal;
    surface.facet_turn = 0.0;
    surface.facet_drift = 0.0;
    surface.N = p.normal;
    surface.E = p.eye;
    surface.albedo = p.extra.xyz;
    surface.f0 = vec3(p.f0) * p.extra.yzw;
    surface.roughness = p.roughness;
    surface.emission = vec3(0.0);
    surface.side = 1.0;
    surface.NoE = dot(p.normal, p.eye);
    surface.f90 = 0.0;
    surface.through = vec3(1.0);
    surface.fresnel_1 = p.extra.xyz;
    surface.fresnel_2 = p.extra.yzw;
    surface.fresnel_3 = p.extra.zwx;
    surface.fresnel_4 = p.extra.wxy;
    surface.missing = GgxMissing(0.0, vec4(0.0), vec4(0.0), 0.0);
    surface.between = vec3(0.0);
    surface.weights = OrenNayarWeights(1.0, 0.0);
    specular_interface(surface);
    rough_diffuse_weights(surface);
    return surface;
}

// The sum of the channels, so that none is left out. What is done once a pixel is done for each lamp here.
float value_of(ProbeInput p, int tier) {
    Surface surface = probed_surface(p);
    Incident incident = Incident(p.light, vec3(1.0), 0.0, true);
    Lobes lobes = Lobes(vec3(0.0), vec3(0.0));
    if (LIGHTING == LIGHTING_SLIDES) {
        lobes = slides_light(surface, incident);
    } else {
        lobes = mixed_light(surface, incident);
    }
    vec3 radiance = lobes.diffuse + lobes.specular;
    return radiance.r + radiance.g + radiance.b;
}

#include "probe/evaluate.glsl"
