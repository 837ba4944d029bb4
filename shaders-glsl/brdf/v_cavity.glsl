// How much of a facet is neither shadowed nor masked? Torrance and Sparrow 1967: long symmetric V-cavities.

// G times h.h of `G_VCavity`, for those who divide by more than that.
float G_hh_VCavity(float NoL, float NoE, float hh) {
    return min(hh, 4.0 * (NoL + NoE) * min(NoL, NoE));
}

// h = L + E is not normalised: hh = h.h and NoL + NoE = N.h.
// min(1, 2 NoH NoE / EoH, 2 NoH NoL / EoH) with NoH = (NoL + NoE) / |h| and EoH = |h| / 2. Needs hh > 0.
// Errs by at most 2e-6 of itself, and by what the cosines bring: 2e-7 / min(NoL, NoE) in 32 bits.
float G_VCavity(float NoL, float NoE, float hh) {
    return G_hh_VCavity(NoL, NoE, hh) / hh;
}
