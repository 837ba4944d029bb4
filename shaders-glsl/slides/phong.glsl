// What does the slides' Phong model reflect? Dot products: the approximation that the deck starts from.

#include "math/constants.glsl"

// The deck names the three terms and no listing. As classic as it comes (Phong 1975): the exponent is not
// normalised, and there is no highlight where the light is behind the surface.
float PhongDiffuse(vec3 N, vec3 L) {
    return max(0.0, dot(N, L));
}

// pow(0, 0) is undefined: a cosine that is rounding noise gives no highlight, whatever the exponent.
// The cosine is held to 1: a rounding above it would grow with the exponent.
float PhongSpecular(vec3 N, vec3 L, vec3 E, float shininess) {
    vec3 R = reflect(-L, N);
    float RdE = min(dot(R, E), 1.0);
    if (dot(N, L) <= 0.0 || RdE < COS_MIN) {
        return 0.0;
    }
    return pow(RdE, shininess);
}
