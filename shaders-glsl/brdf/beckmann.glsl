// How many facets face a half vector? Beckmann and Spizzichino 1963, as Cook and Torrance 1982 use it.

#include "math/constants.glsl"

// The least roughness m that is evaluated. In 32 bits the half vector's tangent is known to some 1e-7, and D changes
// by 2 (tan / m) (error / m) of itself: measured, at most 8e-7 / m over its whole peak (down to 1e-4 of it), and
// 1 / sqrt(cos) of that for light or eye near the surface. At 1e-3 that is 8e-4. A smoother surface shows the light
// as this one does.
const float M_MIN = 1.0e-3;

// m^2 of a surface under a light of finite size, whose radius over distance has the square r2.
// A mirror shows the light itself: a uniform disc of angular radius r has variance r^2/4 along each axis, the
// half vector turns half as far, so r^2/16; Beckmann's slopes have m^2/2 along each axis. The sum of the two
// is that of m^2 + r^2/8. Exact to second order in r for a light near the normal.
float beckmann_m2(float m, float r2) {
    return max(m * m + 0.125 * r2, M_MIN * M_MIN);
}

// `D_Beckmann` over hh and over `divisor`, 2^-22 to 4, for those who divide by more: one division for all. `over` is at most 2^69, so x and
// steep are at most 2^71. Below x = 87 hh is at most 88 Noh2 (but for rounding) where m <= 1, so steep is below 2^34; what it is multiplied by is at
// most 2^63, and the product below 2^97. Vulkan bounds exp by 3 + 2 |x| units in the last place, which says nothing for a large x; beyond 87
// it is below the least normal number (e^-87.3 = 2^-126), and taken as 0.
float D_Beckmann_over_hh(float sine2, float Noh2, float hh, float m2, float divisor) {
    float scale = 1.0 / (m2 * Noh2 * divisor);
    float over = scale * divisor;
    float x = sine2 * over;
    float steep = hh * over;
    return x < 87.0 ? exp(-x) * steep * (scale * (m2 * INV_PI)) : 0.0;
}

// Distribution per steradian, normalised: its integral against the cosine is 1. exp(-tan^2 / m^2) / (pi m^2 cos^4) with the angle
// between normal and half vector, here of h = L + E, never normalised: tan^2 = sine2 / Noh2 and 1 / cos^2 = hh / Noh2 with
// sine2 = |N x h|^2, Noh2 = (N.h)^2 >= 2^-42, hh = h.h <= 4; m >= 1e-4.
// Where it is at least 1e-6 of its peak and m at least 1e-4, it errs by at most 1e-5 of itself, and by what sine2 and Noh2
// bring: 1e-6 / m + 3e-6 / min(N.L, N.E) where they are made in 32 bits: near the surface N.h is known to 2e-7 of 1, and
// the exponent has its square below it.
float D_Beckmann(float sine2, float Noh2, float hh, float m2) {
    return hh * D_Beckmann_over_hh(sine2, Noh2, hh, m2, 1.0);
}
