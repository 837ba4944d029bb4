// How do sums and products keep the digits that 32 bits round away?
//
// As a second float beside the rounded one: what the rounding lost, exactly. Every step is PRECISE: reassociated or contracted, it would
// keep nothing. Rounding to nearest is taken for granted; Vulkan leaves the mode open, and every known device has this one.

// a + b, exactly. Knuth, The Art of Computer Programming 2, section 4.2.2, theorem B.
vec2 two_sum(float a, float b) {
    PRECISE float sum = a + b;
    PRECISE float b_kept = sum - a;
    PRECISE float a_kept = sum - b_kept;
    PRECISE float lost = (a - a_kept) + (b - b_kept);
    return vec2(sum, lost);
}

// a as two floats of 12 bits each, so that their products are exact: the first is a rounded to its upper 12 bits, halves away from 0.
// |a| < 2^127.
vec2 halves(float a) {
    float high = uintBitsToFloat((floatBitsToUint(a) + 0x800u) & 0xfffff000u);
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

// a.b to 2^-23 of itself and 2^-45 of the sum of the |a_i b_i|: Ogita, Rump and Oishi 2005, "Accurate sum and dot product",
// algorithm 5.3, but for what its last sum loses: that is 2^-25 of the sum, and where the rest is comparable with the sum, it is below
// 2^-22, and its loss 2^-47.
float dot_compensated(vec3 a, vec3 b) {
    vec2 x = two_product(a.x, b.x);
    vec2 y = two_product(a.y, b.y);
    vec2 z = two_product(a.z, b.z);
    vec2 xy = two_sum(x.x, y.x);
    PRECISE float lost = ((x.y + y.y) + z.y) + xy.y;
    PRECISE float sum = (xy.x + z.x) + lost;
    return sum;
}

// a x b as it stands.
vec3 cross_precise(vec3 a, vec3 b) {
    PRECISE float x = a.y * b.z - a.z * b.y;
    PRECISE float y = a.z * b.x - a.x * b.z;
    PRECISE float z = a.x * b.y - a.y * b.x;
    return vec3(x, y, z);
}

// a x (b + c), each component to 2^-23 of itself and 2^-34 of |a| |b + c|. Where a and b + c are nearly parallel, the coarse part
// is a difference of exact products, mostly exact itself; the fine part is at most 2^-11 of the whole, so that its rounding is 2^-35.
vec3 cross_of_sum(vec3 a, vec3 b, vec3 c) {
    vec2 x = two_sum(b.x, c.x);
    vec2 y = two_sum(b.y, c.y);
    vec2 z = two_sum(b.z, c.z);
    vec3 sum = vec3(x.x, y.x, z.x);
    vec2 a_x = halves(a.x);
    vec2 a_y = halves(a.y);
    vec2 a_z = halves(a.z);
    vec2 sum_x = halves(sum.x);
    vec2 sum_y = halves(sum.y);
    vec2 sum_z = halves(sum.z);
    vec3 a_high = vec3(a_x.x, a_y.x, a_z.x);
    PRECISE vec3 sum_low = vec3(sum_x.y, sum_y.y, sum_z.y) + vec3(x.y, y.y, z.y);
    vec3 coarse = cross_precise(a_high, vec3(sum_x.x, sum_y.x, sum_z.x));
    PRECISE vec3 fine = cross_precise(a_high, sum_low) + cross_precise(vec3(a_x.y, a_y.y, a_z.y), sum);
    PRECISE vec3 whole = coarse + fine;
    return whole;
}
