// What is left of a number in 16 bits?

// The nearest half float. An operation on halves in 32 bits, rounded so, is the same as one in 16 bits: 24 bits are at least
// twice 11 and two (Figueroa 1995), so rounding twice is rounding once. Vulkan leaves the direction open.
float half_of(float x) {
    return unpackHalf2x16(packHalf2x16(vec2(x, 0.0))).x;
}
