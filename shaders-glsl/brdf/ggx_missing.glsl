// What do GGX facets lose that reflect once? A polynomial.

// The least alpha that it holds for. A smoother surface loses less than 1e-5 of the light from all around.
const float MISSING_ALPHA_MIN = 1.0e-3;

// What depends on alpha alone, of 1 - E(mu) = (1 - z) (c_0 + c_1 z + ... + c_7 z^7), z = bend (1 - mu) / (mu + bend): 0 at the
// normal, 1 at grazing. E: the directional albedo of `ggx` for F = 1.
struct GgxMissing {
    float bend;
    vec4 low;   // c_0 to c_3
    vec4 high;  // c_4 to c_7
    float mean; // of 1 - E over the cosine, 2 int (1 - E) mu dmu
};

// alpha: 0..1, below MISSING_ALPHA_MIN as that. Each c is a polynomial in alpha - 1/2 over 1 + 8 alpha^2; far from grazing
// alpha^2 is missing, so c_0 has that, and c_1 alpha, as a factor. The mean has a logarithm beside: it is the integral of
// (alpha / mu)^2 mu down to mu = alpha. bend is where what is missing turns, from a line at grazing to a square.
//
// The numbers make the largest error over 1e-3 (near grazing, mu < alpha) or 1e-3 (1 - E) / (0.01 + 1 - E) (elsewhere) least, by
// reweighted least squares of quadratures at 45 alpha and some hundred mu; tests/cpu/ggx_missing.rs makes them once more.
GgxMissing ggx_missing_of(float roughness) {
    float alpha = max(roughness, MISSING_ALPHA_MIN);
    float alpha2 = alpha * alpha;
    float s = alpha - 0.5;
    float over = 1.0 / (1.0 + 8.0 * alpha2);
    vec4 low = vec4(-2.416939, -11.81922, -557.9875, 669.5613);
    low = low * s + vec4(6.211835, 80.4234, -145.1218, -170.8742);
    low = low * s + vec4(-5.476212, 10.98941, 267.3126, -427.9619);
    low = low * s + vec4(-2.126815, -43.59609, 69.9913, 72.22349);
    low = low * s + vec4(6.786085, -8.410924, -29.19835, 117.9715);
    low = low * s + vec4(3.742353, 3.326287, -6.826363, 18.96958);
    vec4 high = vec4(3474.775, -11191.96, 11849.05, -4324.743);
    high = high * s + vec4(1517.156, -2702.211, 1998.358, -538.5527);
    high = high * s + vec4(-1003.707, 3876.951, -4235.573, 1561.324);
    high = high * s + vec4(-683.2833, 1360.949, -1180.344, 389.3223);
    high = high * s + vec4(-224.4113, 261.5037, -188.4515, 65.2021);
    high = high * s + vec4(-42.21682, 68.71148, -63.52144, 24.18554);
    float mean = 12.62672;
    mean = mean * s - 21.52054;
    mean = mean * s + 26.72551;
    mean = mean * s - 48.39753;
    mean = mean * s - 60.67771;
    mean = mean * s + 19.17741;
    mean = mean * s + 15.75679;
    mean += log(alpha) * ((70.77567 * alpha + 2.00304) * alpha - 1.154015);
    return GgxMissing(
        1.6 * alpha / (1.0 + 9.0 * alpha2),
        low * vec4(alpha2, alpha, 1.0, 1.0) * over,
        high * over,
        mean * alpha2 * over
    );
}

// 1 - E towards a direction with that cosine, 0..1: within 1e-3, and never negative.
float ggx_missing(GgxMissing missing, float cosine) {
    float over = 1.0 / (cosine + missing.bend);
    float z = missing.bend * (1.0 - cosine) * over;
    vec4 low = missing.low;
    vec4 high = missing.high;
    float sum = high.x + z * (high.y + z * (high.z + z * high.w));
    sum = low.x + z * (low.y + z * (low.z + z * (low.w + z * sum)));
    return sum * (cosine * (1.0 + missing.bend) * over);
}
