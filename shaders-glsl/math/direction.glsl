// How is a vector normalised so that no input makes a NaN?

// Division is defined by Vulkan for divisors within [2^-126, 2^126]; outside them a vector has no direction.
const float LENGTH_MIN = 1.1754943508222875e-38; // 2^-126, the least normal number
const float LENGTH_MAX = 8.507059173023462e37;   // 2^126

// The unit vector along v, or `otherwise` where v has no direction. The largest component is divided out
// first, so that no square leaves the range of a float: the dot product lies in [1, 3].
vec3 direction_or(vec3 v, vec3 otherwise) {
    float largest = max(max(abs(v.x), abs(v.y)), abs(v.z));
    if (largest >= LENGTH_MIN && largest <= LENGTH_MAX) {
        vec3 scaled = v / largest;
        return scaled * inversesqrt(dot(scaled, scaled));
    }
    return otherwise;
}
