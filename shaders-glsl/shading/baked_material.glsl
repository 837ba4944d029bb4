// Which material is compiled into this pipeline? For the benchmark: the renderer bakes no number.
//
// A specialization constant is an int here as everywhere; it holds the bits of a float.

#include "interface/materials.glsl"

layout(constant_id = 32) const int BAKED_ALBEDO_R = 0;
layout(constant_id = 33) const int BAKED_ALBEDO_G = 0;
layout(constant_id = 34) const int BAKED_ALBEDO_B = 0;
layout(constant_id = 35) const int BAKED_OPACITY = 0;
layout(constant_id = 36) const int BAKED_F0_R = 0;
layout(constant_id = 37) const int BAKED_F0_G = 0;
layout(constant_id = 38) const int BAKED_F0_B = 0;
layout(constant_id = 39) const int BAKED_ROUGHNESS = 0;
layout(constant_id = 40) const int BAKED_EMISSION_R = 0;
layout(constant_id = 41) const int BAKED_EMISSION_G = 0;
layout(constant_id = 42) const int BAKED_EMISSION_B = 0;
layout(constant_id = 43) const int BAKED_SHININESS = 0;
layout(constant_id = 44) const int BAKED_EFFECTS = 0;

// All but what maps need.
Material baked_material(Material material) {
    material.albedo = vec3(
        intBitsToFloat(BAKED_ALBEDO_R), intBitsToFloat(BAKED_ALBEDO_G), intBitsToFloat(BAKED_ALBEDO_B)
    );
    material.opacity = intBitsToFloat(BAKED_OPACITY);
    material.f0 = vec3(intBitsToFloat(BAKED_F0_R), intBitsToFloat(BAKED_F0_G), intBitsToFloat(BAKED_F0_B));
    material.roughness = intBitsToFloat(BAKED_ROUGHNESS);
    material.emission = vec3(
        intBitsToFloat(BAKED_EMISSION_R), intBitsToFloat(BAKED_EMISSION_G), intBitsToFloat(BAKED_EMISSION_B)
    );
    material.shininess = intBitsToFloat(BAKED_SHININESS);
    material.effects = uint(BAKED_EFFECTS);
    return material;
}
