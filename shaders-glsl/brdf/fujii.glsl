// How does a rough matte surface scatter without a dark ring? Fujii's improvement of Oren and Nayar's qualitative model.
//
// Fujii, "Improvements of Oren-Nayar Reflectance Model", mimosa-pudica.net/improved-oren-nayar.html.

#include "brdf/oren_nayar.glsl"

// 1/2 - 2/(3 pi): what roughness takes from the lobe's albedo at the normal.
const float FUJII_C1 = 0.28779341;

// roughness: 0..1. A = 1 / (1 + C1 r), B = r A: the lobe never gives back more light than it gets.
OrenNayarWeights fujii_weights(float roughness) {
    float A = 1.0 / (1.0 + FUJII_C1 * roughness);
    return OrenNayarWeights(A, roughness * A);
}

// pi f NoL for albedo 1: NoL (A + B s / t), t = max(NoL, NoE) for s > 0, else 1; s = L.E - NoL NoE. 0 for a light at or below
// the surface; an eye below it is allowed. s >= -1, which rounding breaks by 1e-7: held there, A + B s >= 0.
// For cosines from 1e-6 on it errs as oren_nayar_lobe does.
float fujii_lobe(OrenNayarWeights weights, float NoL, float NoE, float s) {
    if (NoL < COS_MIN) {
        return 0.0;
    }
    float share = s <= 0.0 || NoL < NoE ? NoL : 1.0;
    if (s > 0.0 && NoL < NoE) {
        share = NoL / NoE;
    }
    return weights.A * NoL + weights.B * max(s, -1.0) * share;
}

// The same with s in 32 bits.
float fujii(OrenNayarWeights weights, float NoL, float NoE, float LoE) {
    return fujii_lobe(weights, NoL, NoE, LoE - NoL * NoE);
}
