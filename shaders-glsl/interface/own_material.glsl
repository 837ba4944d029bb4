// Which material was bound for this draw? For the benchmark: the renderer binds none.

#include "interface/materials.glsl"

layout(set = 1, binding = 0, std140) uniform OwnMaterialBlock {
    Material own_material;
};
