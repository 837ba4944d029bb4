// How much does an interface reflect in 16 bits? As `F_Schlick`, every operation rounded to a half float.

#include "math/half_float.glsl"

// One channel; the argument is made in 32 bits and rounded once. Errs by at most 5e-3 of itself for f0 from 1e-3 on.
float F_Schlick_half(float f0, float one_minus_cos) {
    float f = half_of(f0);
    float f90 = half_of(min(1.0, half_of(50.0 * f)));
    float x = half_of(one_minus_cos);
    float x2 = half_of(x * x);
    float x5 = half_of(half_of(x2 * x2) * x);
    return half_of(f + half_of(half_of(f90 - f) * x5));
}
