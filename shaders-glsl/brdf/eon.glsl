// How does a rough matte surface scatter that loses no light? Portsmouth, Kutz and Hill, "EON: A Practical Energy-Preserving
// Rough Diffuse BRDF", JCGT 14(1), 2025.
//
// Fujii's lobe, and what it is missing given back by a lobe of the shape of what is missing on both sides. The paper's exact
// albedo cancels near grazing; here the missing part itself is a sum, of which no term is a small difference.

#include "brdf/fujii.glsl"
#include "math/arcsine.glsl"

// 2/3 - 28/(15 pi): <E> = (1 + C2 r) / (1 + C1 r) is the mean albedo of Fujii's lobe.
const float EON_C2 = 0.07248821;

// K of 1 - E(mu) = r A K(mu), E the directional albedo of Fujii's lobe: 0 at grazing, C1 at the normal. mu: 0..1; errs by 1e-6 of
// itself. With S = sqrt(1 - mu^2), q = (1 + S + S^2) / (1 + S):
// pi K = (pi/2 - 2/3) mu^2 / (1 + S) + S asin mu + S mu (S - 2 q / 3), and (pi/2 - 2/3) / pi is C1.
float eon_missing(float mu) {
    float S = sqrt((1.0 - mu) * (1.0 + mu));
    float over = 1.0 / (1.0 + S);
    float q = (1.0 + S * (1.0 + S)) * over;
    float turned = arcsine(mu) + mu * (S - 2.0 / 3.0 * q);
    return FUJII_C1 * mu * mu * over + INV_PI * S * turned;
}

// pi f NoL of what bounces between facets, per channel: rho_ms (1 - E(l)) (1 - E(e)) / (1 - <E>) NoL, with
// rho_ms = rho^2 <E> / (1 - rho (1 - <E>)). All but one r A cancels: r A K(l) K(e) / (C1 - C2), which no roughness divides by 0.
vec3 eon_bounced(vec3 albedo, float roughness, OrenNayarWeights weights, float NoL, float NoE) {
    if (NoL < COS_MIN) {
        return vec3(0.0);
    }
    float missing = eon_missing(min(NoL, 1.0)) * eon_missing(clamp(NoE, 0.0, 1.0));
    float mean = (1.0 + EON_C2 * roughness) * weights.A;
    float lost = (FUJII_C1 - EON_C2) * roughness * weights.A;
    vec3 again = albedo * albedo * mean / (1.0 - albedo * lost);
    return again * (weights.B * missing / (FUJII_C1 - EON_C2) * NoL);
}
