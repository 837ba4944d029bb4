// How does a rough matte surface scatter in 16 bits? As `oren_nayar`, every operation rounded to a half float.

#include "math/constants.glsl"
#include "math/half_float.glsl"

// sigma 0..1; the cosines are made in 32 bits and rounded once. A sigma below 1.7e-4 has no square in 16 bits, and is 0.
// For cosines from 0.01 on it errs by at most 2e-3 of itself, and by what s brings: 1e-3 / min(NoL, NoE).
float oren_nayar_half(float sigma, float NoL, float NoE, float LoE) {
    float l = half_of(NoL);
    float e = half_of(NoE);
    if (NoL < COS_MIN || l <= 0.0) {
        return 0.0;
    }
    float sigma_half = half_of(sigma);
    float sigma2 = half_of(sigma_half * sigma_half);
    float A = half_of(1.0 - half_of(half_of(0.5 * sigma2) / half_of(sigma2 + half_of(0.33))));
    float B = half_of(half_of(half_of(0.45) * sigma2) / half_of(sigma2 + half_of(0.09)));
    float scale = half_of(1.0 / max(1.0, half_of(A + half_of(0.5 * B))));
    float s = max(half_of(half_of(LoE) - half_of(l * e)), 0.0);
    float foreshortening = l >= e ? 1.0 : half_of(l / e);
    float first = half_of(half_of(A * scale) * l);
    float second = half_of(half_of(half_of(B * scale) * s) * foreshortening);
    return half_of(first + second);
}
