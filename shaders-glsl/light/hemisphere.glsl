// What do the surroundings send: a sky above the horizon, a ground below it?

#include "math/constants.glsl"

// Mean radiance over the cosine-weighted hemisphere about N. Exact: a plane tilted by t sees the share
// (1 + cos t) / 2 of a uniform sky, and the rest is ground. Times the albedo it is Lambert's radiance.
vec3 hemisphere_diffuse(vec3 sky, vec3 ground, vec3 N) {
    // A unit vector of 32 bits may be longer than 1 by some 1e-7, and a share must not pass 1.
    return mix(ground, sky, clamp(0.5 + 0.5 * N.y, 0.0, 1.0));
}

// Radiance that the facets of roughness m > 0 mirror to E. An approximation: the mirror direction, lifted towards N
// because facets send nothing below the surface, sees the horizon as a step of width 0.8 m. The two numbers were
// fitted to the Cook-Torrance lobe: the share of sky is within 0.17 of it, 0.06 in the mean square
// (tests/cpu/hemisphere.rs).
// The lifted direction is not normalised. Its square is held above 0 for an eye straight behind the surface.
vec3 hemisphere_specular(vec3 sky, vec3 ground, vec3 N, vec3 E, float NoE, float m) {
    vec3 lifted = reflect(-E, N) + N * (1.5 * m * m / (m + max(NoE, 0.0)));
    float width2 = 0.64 * m * m * max(dot(lifted, lifted), 1.0e-3);
    float height = lifted.y * inversesqrt(lifted.y * lifted.y + width2);
    return mix(ground, sky, clamp(0.5 + 0.5 * height, 0.0, 1.0));
}
