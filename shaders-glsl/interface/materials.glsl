// Which numbers make a material? All that differs between materials is data.

struct Material {
    vec3 albedo;        // diffuse reflectance, linear sRGB, 0..1; a metal has none
    float opacity;      // 0..1; 1 hides what lies behind
    vec3 f0;            // specular reflectance at normal incidence, 0..1
    float roughness;    // sigma of Oren-Nayar (radians) and m of Beckmann, 0..1
    vec3 emission;      // radiance given off, cd/m^2
    float shininess;    // Phong's exponent, >= 0
    uint effects;       // bits of the effects that this material calls for
    float metalness;    // factor of the metalness map
    float normal_scale; // factor of the normal map's x and y
    float alpha_cutoff; // below it the alpha mask leaves no surface
    vec2 map_repeat;    // repeats of the maps per unit of the texture coordinates
    uint base_color_map; // handles, as maps/sample.glsl reads them
    uint emission_map;
    uint normal_map;
    uint roughness_map;
    uint metalness_map;
    uint occlusion_map;
    uint alpha_mask;
    uint material_padding_0;
    uint material_padding_1;
    uint material_padding_2;
    vec3 fresnel_1;     // what the pipeline's Fresnel term needs beside f0. f82: the tint at 82 degrees; dielectric: the mean of F;
    float material_padding_3; // conductor: n, k and the mean of F; spectral: the four coefficients
    vec3 fresnel_2;
    float material_padding_4;
    vec3 fresnel_3;
    float material_padding_5;
    vec3 fresnel_4;
    float material_padding_6;
};

layout(set = 0, binding = 2, std430) readonly buffer MaterialBlock {
    Material materials[];
};
