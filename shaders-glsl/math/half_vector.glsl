// What do lobes of facets need of the vector half-way between light and eye?

// Of h = L + E, which is never normalised.
struct HalfVector {
    float Noh;         // N.h = N.L + N.E
    float sine2;       // |N x h|^2
    float hh;          // h.h
    float difference2; // |L - E|^2 = 4 - hh
};

// tan^2 comes from the cross product, which keeps the digits that 1 - (N.H)^2 loses. For cosines of at least COS_MIN N.h is at
// least 2^-21 with an error of 2^-22, so hh is at least 2^-44: nothing that divides by it divides by 0.
HalfVector half_vector(vec3 N, vec3 L, vec3 E, float NoL, float NoE) {
    vec3 h = L + E;
    vec3 difference = L - E;
    vec3 sine = cross(N, h);
    return HalfVector(NoL + NoE, dot(sine, sine), dot(h, h), dot(difference, difference));
}

// Cosine between light and facet, E.H = |h|/2.
float half_cosine(HalfVector h) {
    return 0.5 * sqrt(h.hh);
}

// 1 less it: |L-E|^2 / (4 (1 + E.H)) because |L+E|^2 + |L-E|^2 = 4. No cancellation, never negative.
float half_rest(HalfVector h) {
    return h.difference2 / (4.0 + 2.0 * sqrt(h.hh));
}
