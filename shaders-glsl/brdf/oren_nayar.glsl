// How does a rough matte surface scatter? Oren and Nayar 1994 (qualitative model), without trigonometry.

#include "math/constants.glsl"

// The model's two weights, divided by the lobe's largest directional albedo where that exceeds 1.
struct OrenNayarWeights {
    float A;
    float B;
};

// sigma: standard deviation of the facets' slope angle, radians, 0..1. Oren and Nayar 1994, eq. 30.
// For albedo 1 the directional albedo grows towards grazing, where it is A + B/2: at most 1.01518
// (sigma = 0.1985), above 1 for sigma < 0.32613. Dividing by it there keeps the lobe from making light.
OrenNayarWeights oren_nayar_weights(float sigma) {
    float sigma2 = sigma * sigma;
    float A = 1.0 - 0.5 * sigma2 / (sigma2 + 0.33);
    float B = 0.45 * sigma2 / (sigma2 + 0.09);
    float scale = 1.0 / max(1.0, A + 0.5 * B);
    return OrenNayarWeights(A * scale, B * scale);
}

// pi f NoL for albedo 1. 0 for a light at or below the surface; an eye below it (NoE < 0, the silhouette of a
// smooth normal) is allowed, and the formula stands.
//
// The paper's NoL (A + B max(0, cos dphi) sin(alpha) tan(beta)) with alpha the larger angle, beta the smaller:
// s = LoE - NoL NoE = sin(theta_l) sin(theta_e) cos(dphi), and sin(alpha) tan(beta) = sin sin / max(NoL, NoE).
// Hence NoL (A + B max(0, s) / max(NoL, NoE)); the division remains only where NoE > NoL >= COS_MIN.
// For cosines from 1e-6 on it errs by at most 2e-6 of itself, and by what s brings: in 32 bits 2e-7 / min(NoL, NoE).
float oren_nayar_lobe(OrenNayarWeights weights, float NoL, float NoE, float s) {
    if (NoL < COS_MIN) {
        return 0.0;
    }
    float foreshortening = NoL >= NoE ? 1.0 : NoL / NoE;
    return weights.A * NoL + weights.B * max(s, 0.0) * foreshortening;
}

// The same with s in 32 bits.
float oren_nayar(OrenNayarWeights weights, float NoL, float NoE, float LoE) {
    return oren_nayar_lobe(weights, NoL, NoE, LoE - NoL * NoE);
}
