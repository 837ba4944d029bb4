// Which facets does this pipeline's interface have?

#include "brdf/beckmann_smith.glsl"
#include "brdf/blinn_phong.glsl"
#include "brdf/cook_torrance.glsl"
#include "brdf/ggx.glsl"
#include "interface/variants.glsl"

// f NoL / F for cosines of at least COS_MIN. m2: of beckmann_m2; m is the alpha of the others.
float facets(HalfVector h, float NoL, float NoE, float m2) {
    if (SPECULAR == SPECULAR_BLINN_PHONG) {
        return blinn_phong(h.sine2 / (h.Noh * h.Noh), NoL, m2);
    }
    if (SPECULAR == SPECULAR_BECKMANN_SMITH) {
        return beckmann_smith(h, NoL, NoE, m2);
    }
    if (SPECULAR == SPECULAR_BECKMANN_SMITH_EXACT) {
        return beckmann_smith_exact(h, NoL, NoE, m2);
    }
    if (SPECULAR == SPECULAR_GGX || SPECULAR == SPECULAR_GGX_MULTI) {
        return ggx(h, NoL, NoE, m2);
    }
    return cook_torrance_facets(h, NoL, NoE, m2);
}
