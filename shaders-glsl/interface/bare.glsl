// What do the barest draws know? For the benchmark: triangles in cells, each in one of a few shades.

struct Bare {
    uint columns; // cells in a row
    uint rows;
    uint draws;   // triangles
    uint shades;  // 1 to draws
    uint sorted;  // 1: those of a shade follow each other; 0: shades take turns
    uint bare_padding_0;
    uint bare_padding_1;
    uint bare_padding_2;
};

layout(set = 0, binding = 0, std140) uniform BareBlock {
    Bare bare;
};
