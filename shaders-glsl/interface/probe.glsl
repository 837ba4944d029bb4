// What does the probe read and write?

struct ProbeInput {
    vec3 normal; // N
    float roughness;
    vec3 light; // L
    float f0;
    vec3 eye; // E
    uint place; // of the input among those of its invocation
    vec4 extra; // what the function takes beside
};

struct ProbeResult {
    float value;
    uint nans; // values of the invocation that are none
    uint infinities;
    uint negatives;
};

layout(set = 0, binding = 0, std430) buffer ProbeInputBlock {
    ProbeInput probe_inputs[];
};

layout(set = 0, binding = 1, std430) buffer ProbeResultBlock {
    ProbeResult probe_results[];
};

layout(push_constant) uniform ProbePushBlock {
    uint probe_seed;
    uint probe_first;   // number of the first invocation, so that chunks continue each other
    uint probe_count;   // invocations
    uint probe_repeats; // inputs of each, at least 1; 1 where the host gives them
    vec4 probe_low;     // range of `extra`
    vec4 probe_high;
};
