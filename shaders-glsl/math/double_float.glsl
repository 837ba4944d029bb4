// How do sums and products keep the digits that 32 bits round away?
//
// A double-float x is the sum x.x + x.y of two floats, of which the second is at most half a unit in the last place of
// the first: 48 bits. Every step is PRECISE: reassociated or contracted, it would keep nothing. Rounding to nearest is
// taken for granted; Vulkan leaves the mode open, and every known device has this one.

// a + b, exactly. Knuth, The Art of Computer Programming 2, section 4.2.2, theorem B.
vec2 two_sum(float a, float b) {
    PRECISE float sum = a + b;
    PRECISE float b_kept = sum - a;
    PRECISE float a_kept = sum - b_kept;
    PRECISE float lost = (a - a_kept) + (b - b_kept);
    return vec2(sum, lost);
}

// a as two floats of 12 bits each, so that their products are exact. Veltkamp 1968. 4097 = 2^12 + 1; |a| < 2^115.
vec2 halves(float a) {
    PRECISE float spread = 4097.0 * a;
    PRECISE float high = spread - (spread - a);
    PRECISE float low = a - high;
    return vec2(high, low);
}

// a b, exactly where it is at least 2^-102 (below, what is lost leaves the range of a float). Dekker 1971.
vec2 two_product(float a, float b) {
    vec2 p = halves(a);
    vec2 q = halves(b);
    PRECISE float product = a * b;
    PRECISE float high = product - p.x * q.x;
    PRECISE float middle = (high - p.y * q.x) - p.x * q.y;
    PRECISE float lost = p.y * q.y - middle;
    return vec2(product, lost);
}

// a - b, to 2^-46 of |a| + |b|.
vec2 subtract_double(vec2 a, vec2 b) {
    vec2 high = two_sum(a.x, -b.x);
    PRECISE float low = high.y + (a.y - b.y);
    return two_sum(high.x, low);
}

// a b, to 2^-46 of itself.
vec2 multiply_double(vec2 a, vec2 b) {
    vec2 high = two_product(a.x, b.x);
    PRECISE float low = high.y + (a.x * b.y + a.y * b.x);
    return two_sum(high.x, low);
}

// a.b, to 2^-45 of the sum of the |a_i b_i|, and then to half a unit in its last place: Ogita, Rump and Oishi 2005,
// "Accurate sum and dot product", algorithm 5.3.
vec2 dot_double(vec3 a, vec3 b) {
    vec2 x = two_product(a.x, b.x);
    vec2 y = two_product(a.y, b.y);
    vec2 z = two_product(a.z, b.z);
    vec2 xy = two_sum(x.x, y.x);
    vec2 xyz = two_sum(xy.x, z.x);
    PRECISE float low = ((x.y + y.y) + z.y) + (xy.y + xyz.y);
    return two_sum(xyz.x, low);
}

// a c - b d for double-floats c and d, rounded once.
float cross_part(float a, vec2 c, float b, vec2 d) {
    vec2 p = two_product(a, c.x);
    vec2 q = two_product(b, d.x);
    vec2 high = two_sum(p.x, -q.x);
    PRECISE float low = high.y + ((p.y - q.y) + (a * c.y - b * d.y));
    PRECISE float part = high.x + low;
    return part;
}

// a x (b + c), each component rounded once.
vec3 cross_of_sum(vec3 a, vec3 b, vec3 c) {
    vec2 x = two_sum(b.x, c.x);
    vec2 y = two_sum(b.y, c.y);
    vec2 z = two_sum(b.z, c.z);
    return vec3(
        cross_part(a.y, z, a.z, y),
        cross_part(a.z, x, a.x, z),
        cross_part(a.x, y, a.y, x)
    );
}
