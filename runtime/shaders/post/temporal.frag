// Temporal filter: adds a frame to the mean of those before, which motion vectors lead to. One triangle over
// the image. Colours are those behind the tone curve, linear, so that no sample outshines the others of its
// pixel. B. Karis, "High-quality temporal supersampling", 2014 (nearest distance, YCoCg); M. Salvi, "An
// excursion in temporal supersampling", 2016 (clipping to mean and deviation).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/push_constants.h"

layout(set = kSetTemporal, binding = kTemporalColor) uniform sampler2D color;
layout(set = kSetTemporal, binding = kTemporalMotion) uniform sampler2D motion;
layout(set = kSetTemporal, binding = kTemporalDistances) uniform sampler2D distances;
layout(set = kSetTemporal, binding = kTemporalEarlierDistances) uniform sampler2D earlier_distances;
// a: samples in the mean, below 0 where the pixel moved
layout(set = kSetTemporal, binding = kTemporalHistory) uniform sampler2D history;
layout(push_constant) uniform Push { TemporalPush push; };

layout(location = 0) out vec4 out_color;
layout(location = 1) out vec4 out_history;

// Samples of a mean, of pixels at rest and of those whose history was clipped or read between pixels.
const float kMaxSamples = 32.0;
const float kMaxMovingSamples = 8.0;
// Motion in pixels below which the pixel itself is read.
const float kStill = 1.0 / 32.0;
// Deviations from the mean of the neighbours to which the history is clipped.
const float kDeviations = 1.5;
// Distances that differ by less, of the larger one, may be those of one surface.
const float kSameSurface = 0.1;

vec3 toLumaChroma(vec3 c) // YCoCg
{
    return vec3(dot(c, vec3(0.25, 0.5, 0.25)), dot(c, vec3(0.5, 0.0, -0.5)), dot(c, vec3(-0.25, 0.5, -0.25)));
}

vec3 fromLumaChroma(vec3 c) { return vec3(c.x + c.y - c.z, c.x + c.z, c.x - c.y - c.z); }

ivec2 inside(ivec2 pixel) { return clamp(pixel, ivec2(0), textureSize(color, 0) - 1); }

// Mean and deviation of 3 x 3 texels, in YCoCg.
struct Moments
{
    vec3 mean;
    vec3 deviation;
};

Moments readMoments(sampler2D image, ivec2 pixel)
{
    vec3 sum = vec3(0.0), squares = vec3(0.0);
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
        {
            vec3 c = toLumaChroma(texelFetch(image, inside(pixel + ivec2(x, y)), 0).rgb);
            sum += c;
            squares += c * c;
        }
    vec3 mean = sum / 9.0;
    return Moments(mean, sqrt(max(squares / 9.0 - mean * mean, vec3(0.0))));
}

// The neighbour, of 3 x 3, that is nearest to the eye: edges move with what is in front of them.
ivec2 findNearest(ivec2 pixel)
{
    ivec2 nearest = pixel;
    float least = texelFetch(distances, pixel, 0).x;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
        {
            ivec2 neighbour = inside(pixel + ivec2(x, y));
            float far = texelFetch(distances, neighbour, 0).x;
            if (far < least)
            {
                least = far;
                nearest = neighbour;
            }
        }
    return nearest;
}

// True if all that the frame before showed around a pixel hid what was at this distance.
bool wasHidden(ivec2 pixel, float distance_then)
{
    float farthest = 0.0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
            farthest = max(farthest, texelFetch(earlier_distances, inside(pixel + ivec2(x, y)), 0).x);
    return farthest < distance_then * (1.0 - kSameSurface);
}

// True if something moved around a pixel of the frame before.
bool hasMoved(ivec2 pixel)
{
    float least = 1.0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
            least = min(least, texelFetch(history, inside(pixel + ivec2(x, y)), 0).a);
    return least < 0.0;
}

// History between pixels: Catmull and Rom's cubic, whose two middle texels along an axis are one tap.
vec3 readBetween(vec2 place)
{
    vec2 size = vec2(textureSize(history, 0));
    vec2 first = floor(place - 0.5) + 0.5;
    vec2 t = place - first;
    vec2 before = t * (-0.5 + t * (1.0 - 0.5 * t));
    vec2 near = 1.0 + t * t * (-2.5 + 1.5 * t);
    vec2 far = t * (0.5 + t * (2.0 - 1.5 * t));
    vec2 behind = t * t * (-0.5 + 0.5 * t);
    vec2 weights[3] = vec2[](before, near + far, behind);
    vec2 places[3] = vec2[](first - 1.0, first + far / (near + far), first + 2.0);
    vec3 sum = vec3(0.0);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 3; ++x)
            sum += weights[x].x * weights[y].y * textureLod(history, vec2(places[x].x, places[y].y) / size, 0.0).rgb;
    return max(sum, vec3(0.0));
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 now = texelFetch(color, pixel, 0).rgb;
    out_color = vec4(now, 1.0);
    out_history = vec4(now, 1.0);
    if (push.has_history == 0u)
        return;
    ivec2 nearest = findNearest(pixel);
    vec2 way = texelFetch(motion, nearest, 0).xy;
    vec2 place = gl_FragCoord.xy + way;
    vec2 size = vec2(textureSize(color, 0));
    if (any(lessThan(place, vec2(0.0))) || any(greaterThanEqual(place, size)))
        return;
    bool is_still = dot(way, way) < kStill * kStill;
    ivec2 earlier = is_still ? pixel : ivec2(place);
    if (wasHidden(earlier, texelFetch(distances, nearest, 0).y))
        return;

    vec4 stored = texelFetch(history, earlier, 0);
    vec3 before = toLumaChroma(is_still ? stored.rgb : readBetween(place));
    Moments around = readMoments(color, pixel);
    vec3 reach = around.deviation;
    // A wire is in the mean of all frames, but not in each of them: what the history has around it counts.
    // The edge that something leaves there as it moves does not.
    if (is_still && !hasMoved(pixel))
        reach = max(reach, readMoments(history, pixel).deviation);
    reach *= kDeviations;
    vec3 ratio = abs(before - around.mean) / (reach + 1.0 / 1024.0);
    float outside = max(max(ratio.x, ratio.y), ratio.z);
    float samples = min(abs(stored.a) + 1.0, kMaxSamples);
    if (outside > 1.0)
    {
        before = around.mean + (before - around.mean) / outside;
        samples = max(samples / outside, 2.0);
    }
    if (!is_still)
        samples = min(samples, kMaxMovingSamples);
    vec3 mean = mix(max(fromLumaChroma(before), vec3(0.0)), now, 1.0 / samples);
    out_color = vec4(mean, 1.0);
    out_history = vec4(mean, is_still ? samples : -samples);
}
