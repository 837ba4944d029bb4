// What do lobes of facets need of the vector half-way between light and eye?

// Of h = L + E, which is never normalised.
struct HalfVector {
    float Noh;         // N.h = N.L + N.E
    float sine2;       // |N x h|^2
    float hh;          // h.h, at least Noh^2
    float difference2; // |L - E|^2 = 4 - hh
};

// tan^2 comes from the cross product, which keeps the digits that 1 - (N.H)^2 loses. |h| >= N.h, which rounding breaks
// where L is close to -E, so hh is held to it.
HalfVector half_vector(vec3 N, vec3 L, vec3 E, float NoL, float NoE) {
    vec3 h = L + E;
    vec3 difference = L - E;
    vec3 sine = cross(N, h);
    float Noh = NoL + NoE;
    return HalfVector(Noh, dot(sine, sine), max(dot(h, h), Noh * Noh), dot(difference, difference));
}

// Cosine between light and facet, E.H = |h|/2.
float half_cosine(HalfVector h) {
    return 0.5 * sqrt(h.hh);
}

// 1 less it: |L-E|^2 / (4 (1 + E.H)) because |L+E|^2 + |L-E|^2 = 4. No cancellation, never negative.
float half_rest(HalfVector h) {
    return 0.25 * h.difference2 / (1.0 + half_cosine(h));
}
