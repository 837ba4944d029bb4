// What bounces between facets more than once? By what single scattering loses.

#include "brdf/ggx_missing.glsl"
#include "brdf/kulla_conty.glsl"
#include "interface/variants.glsl"
#include "shading/fresnel.glsl"
#include "shading/surface.glsl"

// What does not depend on the lamp.
void missing_of(inout Surface surface) {
    if (SPECULAR != SPECULAR_GGX_MULTI) {
        return;
    }
    surface.missing = ggx_missing_of(surface.roughness);
    float missing_eye = ggx_missing(surface.missing, clamp(surface.NoE, 0.0, 1.0));
    surface.between = kulla_conty(missing_eye, surface.missing.mean, F_avg_interface(surface));
}

// f NoL.
vec3 between_facets(Surface surface, float NoL) {
    return surface.between * (ggx_missing(surface.missing, min(NoL, 1.0)) * NoL);
}
