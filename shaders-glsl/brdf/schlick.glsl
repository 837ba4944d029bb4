// How much does an interface reflect? Schlick 1994, with a colour at normal incidence.

// Reflectance at grazing. No interface, no reflection: below f0 = 0.02, less than any real dielectric has, it
// falls to 0 with f0. After Lagarde and de Rousiers 2014, section 3.2; the largest channel stands for their mean, so
// that a saturated colour keeps its grazing reflection.
float f90_of(vec3 f0) {
    return min(1.0, 50.0 * max(max(f0.r, f0.g), f0.b));
}

// one_minus_cos: 1 minus the cosine between the light and the facet's normal, 0..1. Errs by at most 2e-6 of itself for f0 of
// 0 or at least the least normal number.
vec3 F_Schlick(vec3 f0, float f90, float one_minus_cos) {
    float square = one_minus_cos * one_minus_cos;
    return f0 + (f90 - f0) * (square * square * one_minus_cos);
}

// What is not reflected, 1 - F_Schlick, at a cosine of 0..1. Near grazing F is almost 1, and so it is for a mirror: instead
// of a difference, a sum of terms that are not negative. 1 - (1 - c)^5 = c (5 - 10 c + 10 c^2 - 5 c^3 + c^4).
// Errs by 2e-6 of itself: the sum's terms are up to 30 times as large as the sum.
vec3 T_Schlick(vec3 f0, float f90, float c) {
    float rest = c * (5.0 + c * (-10.0 + c * (10.0 + c * (c - 5.0))));
    return (1.0 - f90) + (f90 - f0) * rest;
}

// Reflectance of a rough interface for light from all around, seen under NoE: the facets that the eye sees at
// grazing are tilted towards it, so the rise is held to 1 - m. An approximation (Lagarde 2011, "Adopting a
// physically based shading model"); never more than F_Schlick.
vec3 F_SchlickRough(vec3 f0, float f90, float m, float NoE) {
    float one_minus_cos = 1.0 - clamp(NoE, 0.0, 1.0);
    float square = one_minus_cos * one_minus_cos;
    return f0 + (max(vec3(f90 * (1.0 - m)), f0) - f0) * (square * square * one_minus_cos);
}
