// Which of the published variants is this pipeline? Set when the pipeline is made, never per draw.

layout(constant_id = 0) const int LIGHTING = 2;      // one of the LIGHTING_ values
layout(constant_id = 1) const int TERM_AMBIENT = 1;  // 0 or 1
layout(constant_id = 2) const int TERM_DIFFUSE = 1;  // 0 or 1
layout(constant_id = 3) const int TERM_SPECULAR = 1; // 0 or 1
layout(constant_id = 27) const int DIFFUSE = 2;      // one of the DIFFUSE_ values
layout(constant_id = 28) const int SPECULAR = 2;     // one of the SPECULAR_ values
layout(constant_id = 29) const int FRESNEL = 1;      // one of the FRESNEL_ values
layout(constant_id = 4) const int INSPECTED = 0;     // one of the INSPECT_ values
layout(constant_id = 5) const int INSPECTED_LIGHT = 0; // number of the lamp

// What is written in place of light, where a picture is looked into.
const int INSPECT_NOTHING = 0;
const int INSPECT_NORMAL = 1; // N, and the number of the material
const int INSPECT_EYE = 2;    // E, and the roughness
const int INSPECT_LIGHT = 3;  // L of a lamp, and the largest channel of f0; -1 where nothing arrives
const int INSPECT_POSITION = 4; // world space, m, and how open the place is to its surroundings, 0..1
const int INSPECT_ALBEDO = 5;
const int INSPECT_F0 = 6;
const int INSPECT_EMISSION = 7; // cd/m^2
const int INSPECT_SHADOW = 8;   // how much of a lamp's light comes through, 0..1

const int LIGHTING_PHONG = 0;
const int LIGHTING_SLIDES = 1;
const int LIGHTING_MIXED = 2; // a tier of each of the three ladders below

const int DIFFUSE_SLIDES = 0;
const int DIFFUSE_LAMBERT = 1;
const int DIFFUSE_QON = 2;
const int DIFFUSE_FON = 3;
const int DIFFUSE_FULL_OREN_NAYAR = 4;
const int DIFFUSE_EON = 5;

const int SPECULAR_SLIDES = 0;
const int SPECULAR_BLINN_PHONG = 1;
const int SPECULAR_COOK_TORRANCE = 2;
const int SPECULAR_BECKMANN_SMITH = 3;
const int SPECULAR_BECKMANN_SMITH_EXACT = 4;
const int SPECULAR_GGX = 5;
const int SPECULAR_GGX_MULTI = 6;

const int FRESNEL_SCALE = 0;
const int FRESNEL_SCHLICK = 1;
const int FRESNEL_F82 = 2;
const int FRESNEL_DIELECTRIC = 3;
const int FRESNEL_CONDUCTOR = 4;
const int FRESNEL_SPECTRAL = 5;
