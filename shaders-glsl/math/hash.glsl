// Which numbers does a shader draw by chance, the same on every device?

// A step of a 32-bit generator and its output permutation: PCG-RXS-M-XS (O'Neill 2014), as a hash (Jarzynski and
// Olano 2020, "Hash functions for GPU rendering").
uint hashed(uint x) {
    uint state = x * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

// In [0, 1): 24 bits, as many as a float holds.
float fraction(inout uint state) {
    state = hashed(state);
    return float(state >> 8u) * 5.9604644775390625e-8; // 2^-24
}
