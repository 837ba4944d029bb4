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
    surface.missing_eye = ggx_missing(clamp(surface.NoE, 0.0, 1.0), surface.roughness);
    surface.missing = ggx_missing_on_average(surface.roughness);
}

// f NoL.
vec3 between_facets(Surface surface, float NoL) {
    float missing_light = ggx_missing(min(NoL, 1.0), surface.roughness);
    return kulla_conty(missing_light, surface.missing_eye, surface.missing, F_avg_interface(surface), NoL);
}
