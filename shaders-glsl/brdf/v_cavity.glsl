// How much of a facet is neither shadowed nor masked? Torrance and Sparrow 1967: long symmetric V-cavities.

// G (E.H)^2, for those who multiply by it: h = L + E is not normalised, hh = h.h = (2 E.H)^2 and NoL + NoE = N.h.
float G_EoH2_VCavity(float NoL, float NoE, float hh) {
    return min(0.25 * hh, (NoL + NoE) * min(NoL, NoE));
}

// min(1, 2 NoH NoE / EoH, 2 NoH NoL / EoH) with NoH = (NoL + NoE) / |h| and EoH = |h| / 2. Needs hh > 0.
// Errs by at most 2e-6 of itself, and by what the cosines bring: 2e-7 / min(NoL, NoE) in 32 bits.
float G_VCavity(float NoL, float NoE, float hh) {
    return G_EoH2_VCavity(NoL, NoE, hh) / (0.25 * hh);
}
