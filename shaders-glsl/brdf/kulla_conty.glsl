// Where does the light go that bounces between mirror facets more than once? Kulla and Conty 2017, "Revisiting Physically Based
// Shading at Imageworks".

#include "math/constants.glsl"

// Less light than this is lost to rounding as well.
const float MISSING_MIN = 1.0e-6;

// What does not depend on the light of f NoL = (1 - E(NoL)) NoL kulla_conty(...), of what single scattering misses:
// missing_e = 1 - E(NoE), missing = 1 - E_avg of the lobe for F = 1; F_avg: the cosine-weighted mean of the Fresnel term, 0..1.
// Below MISSING_MIN there is nothing to give back.
//
// F_avg^2 E_avg / (1 - F_avg (1 - E_avg)) scales what (1 - E(l)) (1 - E(e)) / (pi (1 - E_avg)) gives back for F = 1.
vec3 kulla_conty(float missing_e, float missing, vec3 F_avg) {
    if (missing < MISSING_MIN) {
        return vec3(0.0);
    }
    vec3 colour = F_avg * F_avg * (1.0 - missing) / (1.0 - F_avg * missing);
    return colour * (missing_e / missing * INV_PI);
}

// The mean of F_Schlick: f0 + (f90 - f0) / 21.
vec3 F_avg_Schlick(vec3 f0, float f90) {
    return f0 + (f90 - f0) / 21.0;
}
