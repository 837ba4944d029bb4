// Which numbers make a material? All that differs between materials is data.

struct Material {
    vec3 albedo;      // diffuse reflectance, linear sRGB, 0..1; a metal has none
    float opacity;    // 0..1; 1 hides what lies behind
    vec3 f0;          // specular reflectance at normal incidence, 0..1
    float roughness;  // sigma of Oren-Nayar (radians) and m of Beckmann, 0..1
    vec3 emission;    // radiance given off, cd/m^2
    float shininess;  // Phong's exponent, >= 0
};

layout(set = 0, binding = 2, std430) readonly buffer MaterialBlock {
    Material materials[];
};
