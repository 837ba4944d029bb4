// Which function is probed, and with how much arithmetic?

layout(constant_id = 64) const int PROBE_FUNCTION = 0; // one of the FUNCTION_ values of the file that is probed
layout(constant_id = 65) const int PROBE_TIER = 0;     // one of the TIER_ values

const int TIER_F32 = 0;
const int TIER_COMPENSATED = 1;
const int TIER_HALF = 2;

// The least m that a lobe itself is asked for; the picture's materials stop at M_MIN.
const float PROBED_M_MIN = 1.0e-4;
