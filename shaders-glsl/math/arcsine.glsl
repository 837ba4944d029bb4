// What angle has a sine? Vulkan lets asin err by 4096 units in the last place; albedos are made of angles.

const float HALF_PI = 1.5707963267948966;

// asin x for 0 <= x <= 1/2: x + x^3 P(x^2), with P interpolated at the five Chebyshev nodes of x^2 in [0, 1/4]: 2e-8 of itself.
float small_arcsine(float x) {
    float z = x * x;
    float P = 0.16666672 + z * (0.07498855 + z * (0.04500138 + z * (0.026554542 + z * 0.038085024)));
    return x + x * z * P;
}

// asin x for 0 <= x <= 1: 2e-7 of itself. Beyond 1/2 by asin x = pi/2 - 2 asin sqrt((1 - x) / 2), where 1 - x is exact.
float arcsine(float x) {
    bool beyond = x > 0.5;
    float turned = small_arcsine(beyond ? sqrt(0.5 * (1.0 - x)) : x);
    return beyond ? HALF_PI - 2.0 * turned : turned;
}
