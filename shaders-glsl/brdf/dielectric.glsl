// How much does a clear interface reflect? Fresnel 1823, for light that is not polarised, from the outside.

// f0 = ((n - 1) / (n + 1))^2, so with r = sqrt(f0), p = 1 + r, q = 1 - r the index is n = p / q. Multiplied through by q no f0 of 0..1
// divides by 0.
struct Refraction {
    float r;
    float p;
    float q;
    float g;        // q sqrt(n^2 - 1 + mu^2) = sqrt(4 r + (q mu)^2)
    float s_factor; // 1 / (q mu + g)^2
    float p_factor; // 1 / (p^2 mu + q g)^2
};

// mu: cosine, COS_MIN..1. Both divisors are at least 2 COS_MIN.
Refraction refraction(float f0, float mu) {
    float r = sqrt(f0);
    float p = 1.0 + r;
    float q = 1.0 - r;
    float g = sqrt(4.0 * r + q * q * mu * mu);
    float s_divisor = q * mu + g;
    float p_divisor = p * p * mu + q * g;
    float over = 1.0 / (s_divisor * p_divisor);
    float s = p_divisor * over;
    float parallel = s_divisor * over;
    return Refraction(r, p, q, g, s * s, parallel * parallel);
}

// The amplitudes, of which no numerator is a difference of large numbers, are
// s: 4 r / (q mu + g)^2,  p: 4 r ((p^2 + q^2) mu^2 - q^2) / (p^2 mu + q g)^2.
// Errs by 1e-5 of itself for f0 of 1e-6 to 0.2, all clear stuffs; of q a larger f0 leaves fewer digits.
float F_dielectric(float f0, float mu) {
    Refraction at = refraction(f0, mu);
    float squares = (at.p * at.p + at.q * at.q) * mu * mu - at.q * at.q;
    float s = 4.0 * at.r * at.s_factor;
    float parallel = 4.0 * at.r * squares * at.p_factor;
    return 0.5 * (s * s + parallel * parallel);
}

// What is let through, 1 - F, as a sum of products: 4 q mu g / (q mu + g)^2 and 4 p^2 q mu g / (p^2 mu + q g)^2.
float T_dielectric(float f0, float mu) {
    Refraction at = refraction(f0, mu);
    return 2.0 * at.q * mu * at.g * (at.s_factor + at.p * at.p * at.p_factor);
}

// Reflectance per channel.
vec3 F_Dielectric(vec3 f0, float mu) {
    return vec3(F_dielectric(f0.r, mu), F_dielectric(f0.g, mu), F_dielectric(f0.b, mu));
}

// What is let through.
vec3 T_Dielectric(vec3 f0, float mu) {
    return vec3(T_dielectric(f0.r, mu), T_dielectric(f0.g, mu), T_dielectric(f0.b, mu));
}
