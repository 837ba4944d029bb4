// How much does a metal reflect at one wavelength? Fresnel's equations for a complex index n + i k, in real numbers.

// With t = n^2 - k^2 - sin^2: a^2 - b^2 = t, a b = n k, and
// R_s = ((a - mu)^2 + b^2) / ((a + mu)^2 + b^2),
// R_p = R_s ((a mu - sin^2)^2 + b^2 mu^2) / ((a mu + sin^2)^2 + b^2 mu^2)
// (Born and Wolf, section 14.4): sums of squares, that rounding cannot make negative. The smaller of a^2 and b^2 comes from their
// product, since from their sum it would cancel. n, k: 0..100, n^2 + k^2 >= 1e-6; mu: COS_MIN..1, so
// that no index divides by 0. Errs by 1e-5 of itself where it is at least 0.1 straight on, as metals are.
float F_conductor(float n, float k, float mu) {
    float sine2 = (1.0 - mu) * (1.0 + mu);
    float t = n * n - k * k - sine2;
    float product = n * k;
    float larger = 0.5 * (sqrt(t * t + 4.0 * product * product) + abs(t));
    float smaller = product * product / max(larger, 1.0e-12);
    float a2 = t >= 0.0 ? larger : smaller;
    float b2 = t >= 0.0 ? smaller : larger;
    float a = sqrt(a2);
    float less = a - mu;
    float more = a + mu;
    float turned_less = a * mu - sine2;
    float turned_more = a * mu + sine2;
    float mu2b2 = mu * mu * b2;
    float p_less = turned_less * turned_less + mu2b2;
    float p_more = turned_more * turned_more + mu2b2;
    // (R_s + R_p) / 2 over one divisor.
    return 0.5 * (less * less + b2) * (p_less + p_more) / ((more * more + b2) * p_more);
}

// At three wavelengths that stand for the channels.
vec3 F_Conductor(vec3 n, vec3 k, float mu) {
    return vec3(F_conductor(n.r, k.r, mu), F_conductor(n.g, k.g, mu), F_conductor(n.b, k.b, mu));
}
