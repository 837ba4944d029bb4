// How does a rough matte surface scatter, light between its facets included? Oren and Nayar 1994, the full model (eq. 27, 28).

#include "math/arcsine.glsl"
#include "math/constants.glsl"

// Below it the product of two sines is rounding noise, and what is divided by it is 0 or held.
const float SINE_MIN = 1.0e-12;

// The two albedo-free parts: what one facet sends on, and what a second one does.
struct FullOrenNayar {
    float once;  // pi f NoL / albedo
    float twice; // pi f NoL / albedo^2
};

// sigma: radians, 0..1. The paper's angles alpha >= beta are those of the smaller and of the larger cosine. Of its functions of
// angles only the two themselves are left to compute: cos(dphi) C2 tan(beta) = k s / max(NoL, NoE), for s < 0 times
// 1 - (2 beta / pi)^3 / sin(alpha); tan((alpha + beta) / 2) = (sin + sin) / (cos + cos); s = L.E - NoL NoE. Near grazing that
// difference is one of two small numbers: with d = 1 - 2 beta / pi it is d (3 - 3 d + d^2) - low^2 / (1 + sin(alpha)) over sin(alpha).
// So is 1 - |cos(dphi)| = sin(dphi)^2 / (1 + |cos(dphi)|), of which the sine is triple = N.(L x E) over both sines.
// An eye below the surface is taken for one on it.
FullOrenNayar full_oren_nayar_lobe(float sigma, float NoL, float NoE, float s, float triple) {
    if (NoL < COS_MIN) {
        return FullOrenNayar(0.0, 0.0);
    }
    float sigma2 = sigma * sigma;
    float k = 0.45 * sigma2 / (sigma2 + 0.09);
    float low = clamp(min(NoL, NoE), 0.0, 1.0);
    float high = min(max(NoL, NoE), 1.0);
    float sin_alpha = sqrt((1.0 - low) * (1.0 + low));
    float sin_beta = sqrt((1.0 - high) * (1.0 + high));
    // Over a right angle; beta at most alpha.
    float d = arcsine(high) / HALF_PI;
    float alpha = 1.0 - arcsine(low) / HALF_PI;
    float beta = 1.0 - d;
    // At the normal there is no azimuth, and none of the terms asks for it.
    float sines = max(sin_alpha * sin_beta, SINE_MIN);
    float cos_phi = clamp(s / sines, -1.0, 1.0);
    float sin_phi = min(abs(triple) / sines, 1.0);
    float off_plane = sin_phi * sin_phi / (1.0 + abs(cos_phi));

    float C1 = 1.0 - 0.5 * sigma2 / (sigma2 + 0.33);
    float C3 = 0.125 * sigma2 / (sigma2 + 0.09);
    float across = alpha * beta; // (4 alpha beta / pi^2), for angles in right ones
    float away = 1.0;
    if (s < 0.0) {
        away = (d * (3.0 + d * (d - 3.0)) - low * low / (1.0 + sin_alpha)) / max(sin_alpha, SINE_MIN);
    }
    float aside = k * s / high * away;
    float between = off_plane * C3 * across * across * (sin_alpha + sin_beta) / (low + high);
    float second = 0.17 * sigma2 / (sigma2 + 0.13) * (1.0 - cos_phi * beta * beta);
    return FullOrenNayar(NoL * (C1 + aside + between), NoL * second);
}

// pi f NoL, the albedo included. Away from the light, both near grazing, the model of a dark surface falls below 0 for sigma above
// 0.6: there it is 0.
vec3 full_oren_nayar(FullOrenNayar lobe, vec3 albedo) {
    return albedo * max(vec3(lobe.once) + albedo * lobe.twice, vec3(0.0));
}
