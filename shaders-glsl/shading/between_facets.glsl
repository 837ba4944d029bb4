// What bounces between facets more than once? By a table of what single scattering loses.

#include "brdf/kulla_conty.glsl"
#include "interface/missing_table.glsl"
#include "interface/variants.glsl"
#include "shading/fresnel.glsl"
#include "shading/surface.glsl"

// What does not depend on the lamp.
void look_up_missing(inout Surface surface) {
    if (SPECULAR != SPECULAR_GGX_MULTI) {
        return;
    }
    float missing_eye = ggx_missing(clamp(surface.NoE, 0.0, 1.0), surface.roughness);
    float missing = ggx_missing_on_average(surface.roughness);
    surface.between = kulla_conty(missing_eye, missing, F_avg_interface(surface));
}

// f NoL.
vec3 between_facets(Surface surface, float NoL) {
    return surface.between * (ggx_missing(min(NoL, 1.0), surface.roughness) * NoL);
}
