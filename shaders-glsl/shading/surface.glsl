// What is known of a point that is seen? Effects add to it, lamps are then evaluated on it.

#include "brdf/ggx_missing.glsl"
#include "brdf/oren_nayar.glsl"

struct Surface {
    uint effects;    // bits of the effects that its material calls for
    vec3 position;   // world space, m
    vec3 facet;      // unit normal of the triangle itself, of either side
    float facet_turn;  // how far off it may be, radians
    float facet_drift; // how far off the position may be, m
    vec3 N;          // unit, to the side that is seen
    vec3 E;          // unit, to the eye
    vec3 albedo;     // diffuse reflectance, 0..1
    vec3 f0;         // specular reflectance at normal incidence, 0..1
    float roughness; // sigma of Oren-Nayar (radians) and m of Beckmann, 0..1
    vec3 emission;   // radiance given off, cd/m^2
    float side;      // 1 where the front is seen, -1 where the back is
    // What does not depend on the lamp, computed once.
    float NoE;
    float f90;       // reflectance of the interface at grazing; 0 without an interface
    vec3 through;    // what the interface lets out towards the eye, 0..1
    vec3 fresnel_1;  // as the material's
    vec3 fresnel_2;
    vec3 fresnel_3;
    vec3 fresnel_4;
    GgxMissing missing; // what facets lose that reflect once
    vec3 between;    // what bounces between facets towards the eye, over what single scattering loses of a lamp's light
    OrenNayarWeights weights;
};

// What one lamp, or the surroundings, send to the eye, cd/m^2. The base is dimmed by opacity, the interface not.
struct Lobes {
    vec3 diffuse;
    vec3 specular;
};

// What a base scatters of one lamp's light, before its interface: pi f NoL = albedo lobe + rest.
struct Base {
    float lobe;
    vec3 rest; // of models in which the albedo does more than scale
};
