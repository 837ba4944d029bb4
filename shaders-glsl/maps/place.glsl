// Where on its maps does a point lie, and how large is a pixel there?

struct MapPlace {
    vec2 uv; // u right, v down from the picture's upper edge; repeats outside 0..1
    vec2 dx; // change to the next pixel
    vec2 dy;
};
