// How does a glossy surface reflect by a power of a cosine? Blinn 1977, normalised.

#include "math/constants.glsl"

// ln(1 + x) for x >= 0, 4e-7 of itself up to x = 1/2, where GLSL's log may err by 2^-21 of 1:
// 2 artanh z with z = x / (2 + x), four terms of its series.
float log_of_one_and(float x) {
    if (x > 0.5) {
        return log(1.0 + x);
    }
    float z = x / (2.0 + x);
    float z2 = z * z;
    return 2.0 * z * (1.0 + z2 * (1.0 / 3.0 + z2 * (0.2 + z2 / 7.0)));
}

// The power whose highlight is as wide as Beckmann's of roughness m: both fall as 1 - tan^2 / m^2. At least 0, for m = 1.
float blinn_phong_exponent(float m2) {
    return max(2.0 / m2 - 2.0, 0.0);
}

// f NoL / F = (n + 8) / (8 pi) (N.H)^n NoL: with that factor the lobe's directional albedo for light and eye at the normal is 1 to
// 12 % (Akenine-Moeller et al.). tan2: squared tangent between normal and half vector; (N.H)^n = exp(-n/2 ln(1 + tan2)).
// For m of 1e-4 and more n is at most 2e8, and the lobe at most 8e6. Errs by 1e-6 / m where it is at least 1e-6 of its peak.
float blinn_phong(float tan2, float NoL, float m2) {
    float n = blinn_phong_exponent(m2);
    float x = 0.5 * n * log_of_one_and(tan2);
    return x < 87.0 ? (n + 8.0) * (0.125 * INV_PI) * exp(-x) * NoL : 0.0;
}
