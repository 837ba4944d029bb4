// How does a smooth matte surface scatter? Lambert 1760.

#include "math/constants.glsl"

// pi f NoL for albedo 1. 0 for a light at or below the surface.
float lambert(float NoL) {
    return NoL < COS_MIN ? 0.0 : NoL;
}
