// Which numbers do several lighting functions share?

const float INV_PI = 0.318309886183791;

// Below this a cosine of two unit vectors is rounding noise, and nothing is reflected: three products and
// two sums of 24-bit numbers err by at most 3 * 2^-24 = 2^-22.4, so the sign of a smaller one is not known.
// 2^-22 in decimal.
const float COS_MIN = 2.384185791015625e-7;
