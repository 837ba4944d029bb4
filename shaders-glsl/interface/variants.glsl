// Which of the published variants is this pipeline? Set when the pipeline is made, never per draw.

layout(constant_id = 0) const int LIGHTING = 2;      // one of the LIGHTING_ values
layout(constant_id = 1) const int TERM_AMBIENT = 1;  // 0 or 1
layout(constant_id = 2) const int TERM_DIFFUSE = 1;  // 0 or 1
layout(constant_id = 3) const int TERM_SPECULAR = 1; // 0 or 1

const int LIGHTING_PHONG = 0;
const int LIGHTING_SLIDES = 1;
const int LIGHTING_CORRECTED = 2;
