// What stands in the way of a lamp's light? An effect.

#include "effects/called_for.glsl"
#include "interface/frame.glsl"
#include "interface/lights.glsl"
#include "interface/shadow_maps.glsl"
#include "light/incident.glsl"
#include "math/direction.glsl"
#include "shading/surface.glsl"

layout(constant_id = 24) const int EFFECT_SHADOW = -1;
const uint BIT_SHADOW = 4u;
// Drawn corners are snapped to 2^-SHADOW_SNAP_BITS of a texel before a map is filled.
layout(constant_id = 25) const int SHADOW_SNAP_BITS = 4;

layout(set = 0, binding = 18) uniform texture2DArray shadow_depths;
layout(set = 0, binding = 19) uniform sampler shadow_sampler; // nearest

// Depths come from a handful of f32 operations on numbers up to 1, here and in the map: 16 roundings of 2^-24.
const float DEPTH_ROUNDING = 9.5367431640625e-7; // 2^-20
// A position is known to 2^-23 of its distance from the origin or the eye; two of them make a difference.
const float POSITION_ROUNDING = 2.384185791015625e-7; // 2^-22

// The triangle's own normal, from the positions of this pixel and of its neighbours to the right and below. It is off by
// what the positions are off, over the height of the parallelogram that they span.
void shadow_facet(inout Surface surface, vec3 right, vec3 down) {
    if (EFFECT_SHADOW == 0) {
        return;
    }
    vec3 normal = cross(right, down);
    surface.facet = direction_or(normal, surface.N);
    float reach = max(length(surface.position), length(frame.eye.w * (frame.eye.xyz - surface.position)));
    float longest2 = max(dot(right, right), dot(down, down));
    float height2 = dot(normal, normal) / max(longest2, LENGTH_MIN);
    surface.facet_drift = POSITION_ROUNDING * reach;
    surface.facet_turn = min(surface.facet_drift * inversesqrt(max(height2, LENGTH_MIN)), 1.0);
}

// The face of a cube map in which d lies: +x, -x, +y, -y, +z, -z.
uint cube_face(vec3 d) {
    vec3 size = abs(d);
    if (size.x >= size.y && size.x >= size.z) {
        return d.x > 0.0 ? 0u : 1u;
    }
    if (size.y >= size.z) {
        return d.y > 0.0 ? 2u : 3u;
    }
    return d.z > 0.0 ? 4u : 5u;
}

// A surface that rises by more than this many texels' width within a texel faces the lamp at under 3.6 degrees
// (atan 1/16), and gets a sixteenth of its light at most; what stands out farther is taken for another surface.
const float STEEPEST = 16.0;

// What is compared with a map's texels.
struct Receiver {
    vec2 place;  // of the point on the map, texels
    float z;     // depth of the point
    vec2 slope;  // of its plane, depth a texel
    float slack; // by which depths may be off
    float width; // a texel's width as a depth
    int layer;
    int last;    // largest coordinate of a texel
};

float nearest(ivec2 texel, Receiver receiver) {
    ivec3 inside = ivec3(clamp(texel, ivec2(0), ivec2(receiver.last)), receiver.layer);
    return texelFetch(sampler2DArray(shadow_depths, shadow_sampler), inside, 0).r;
}

// 1 where what the map saw at a texel is not before the receiver. Lit, the map saw the receiver's own plane at the texel's
// middle, or what falls away from it; or, where the surface is hollow, what rises from it: then the point is on or
// before the plane of what the map saw, which is known from the texels farther out (out_x and out_y, -1 or 1).
float lit_texel(ivec2 texel, Receiver receiver, int out_x, int out_y) {
    vec2 offset = vec2(clamp(texel, ivec2(0), ivec2(receiver.last))) - receiver.place;
    float seen = nearest(texel, receiver);
    // A texel that saw nothing holds 0, and a plane may end before.
    float rise = seen - max(receiver.z + dot(receiver.slope, offset), 0.0);
    float grows_x = nearest(texel + ivec2(out_x, 0), receiver) - seen;
    float grows_y = nearest(texel + ivec2(0, out_y), receiver) - seen;
    float hollow = seen - abs(offset.x) * grows_x - abs(offset.y) * grows_y;
    bool before = rise <= receiver.slack;
    bool inside = rise <= STEEPEST * receiver.width && hollow <= receiver.z + receiver.slack;
    return before || inside ? 1.0 : 0.0;
}

// How much of the lamp's light comes through map `layer` to the point, 0..1: four texels, weighted as they surround it.
// n: unit normal of the triangle; turn: how far off it may be, radians; drift: how far off the point may be, m.
float lit_share(uint layer, vec3 point, vec3 n, float turn, float drift) {
    mat4 to_clip = shadow_maps[layer].clip;
    vec4 clip = to_clip * vec4(point, 1.0);
    if (clip.w <= LENGTH_MIN) {
        return 1.0;
    }
    mat4 planes = shadow_maps[layer].planes;
    vec3 plane = (planes * vec4(n, -dot(n, point))).xyz;
    // How much each component changes when n turns.
    vec3 swing = turn * vec3(
        length(vec3(planes[0].x, planes[1].x, planes[2].x) - planes[3].x * point),
        length(vec3(planes[0].y, planes[1].y, planes[2].y) - planes[3].y * point),
        length(vec3(planes[0].z, planes[1].z, planes[2].z) - planes[3].z * point)
    );
    int side = textureSize(sampler2DArray(shadow_depths, shadow_sampler), 0).x;
    float texel = 2.0 / float(side);
    // A plane seen edge-on has no slope, and no light.
    float steep = max(abs(plane.z) - swing.z, texel * max(abs(plane.x), abs(plane.y)));
    if (steep <= LENGTH_MIN) {
        return 1.0;
    }
    vec3 ndc = clip.xyz / clip.w;
    vec2 slope = -plane.xy / (plane.z < 0.0 ? -steep : steep) * vec2(texel, -texel);
    // Between |z| - swing and |z| + swing.
    vec2 doubt = (swing.xy + 2.0 * swing.z * abs(plane.xy) / steep) / steep * texel;
    // A texel's middle is at most a texel away each way. A plane that is off by `drift` has its depth off by
    // drift / (w steep): the plane (0, 0, 0, 1) of the world is one of clip space whose product with the point is 1.
    float slack = dot(abs(slope), vec2(exp2(-float(SHADOW_SNAP_BITS)))) + doubt.x + doubt.y
        + drift / (clip.w * steep) + DEPTH_ROUNDING;
    // A step of 1 / |x row| across the lamp's view is w in clip space; along it, depth changes as the rows of z and w say.
    vec3 across = vec3(to_clip[0].x, to_clip[1].x, to_clip[2].x);
    vec3 along = vec3(to_clip[0].z, to_clip[1].z, to_clip[2].z)
        - ndc.z * vec3(to_clip[0].w, to_clip[1].w, to_clip[2].w);
    float width = texel * length(along) / max(length(across), LENGTH_MIN);

    vec2 place = (vec2(0.5, -0.5) * clamp(ndc.xy, -1.0, 1.0) + 0.5) * float(side) - 0.5;
    Receiver receiver = Receiver(place, ndc.z, slope, slack, width, int(layer), side - 1);
    vec2 corner = floor(place);
    vec2 weight = place - corner;
    ivec2 first = ivec2(corner);
    float upper = mix(
        lit_texel(first, receiver, -1, -1), lit_texel(first + ivec2(1, 0), receiver, 1, -1), weight.x
    );
    float lower = mix(
        lit_texel(first + ivec2(0, 1), receiver, -1, 1), lit_texel(first + ivec2(1, 1), receiver, 1, 1), weight.x
    );
    return mix(upper, lower, weight.y);
}

void shadow(inout Incident incident, Light light, Surface surface) {
    if (!called_for(EFFECT_SHADOW, light.effects, BIT_SHADOW)) {
        return;
    }
    // What faces away is dark without being asked about.
    if (dot(surface.N, incident.L) <= 0.0) {
        return;
    }
    uint layer = light.shadow_first;
    if (light.shadow_count > 1u) {
        layer += cube_face(surface.position - light.position.xyz);
    }
    incident.illuminance *=
        lit_share(layer, surface.position, surface.facet, surface.facet_turn, surface.facet_drift);
}
