// Surface of a pixel in four words.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/shaders/scene/directions.glsl"
#include "runtime/shaders/shade/lit_surface.glsl"

// No lights: the sky, or a surface that shading has lit.
const uvec4 kNoSurface = uvec4(0u);

const vec3 kRootSteps = vec3(2047.0, 2047.0, 1023.0);
const float kRoughnessSteps = 16383.0;
const float kMetallicSteps = 1023.0;
const float kFlatNormalSteps = 4094.0; // even: 0 has a code
const uint kReceivesBit = 0x80000000u;

// The normal has 16 + 16 bits and the roughness 14, for highlights; the colour 11, 11 and 10 of its root,
// metallic 10. The normal of the triangle, with 12 + 12 bits, and the error, a half without its sign, move
// points out of their own shadows. The last bit says that baked lamps are counted already.
uvec4 packSurface(LitSurface surface)
{
    uvec3 root = uvec3(round(sqrt(clamp(surface.base, 0.0, 1.0)) * kRootSteps));
    uint roughness = uint(round(surface.roughness * kRoughnessSteps));
    uint metallic = uint(round(surface.metallic * kMetallicSteps));
    uvec2 flat_normal = uvec2(round((octahedralPoint(surface.flat_normal) * 0.5 + 0.5) * kFlatNormalSteps));
    uint error = packHalf2x16(vec2(min(surface.error, 65504.0), 0.0));
    return uvec4(packSnorm2x16(octahedralPoint(surface.normal)), root.r | root.g << 11 | root.b << 22,
                 roughness | metallic << 14 | error << 24,
                 flat_normal.x | flat_normal.y << 12 | error >> 8 << 24 | (surface.receives ? kReceivesBit : 0u));
}

LitSurface unpackSurface(uvec4 words)
{
    LitSurface surface;
    surface.normal = octahedralDirection(unpackSnorm2x16(words.x));
    vec3 root = vec3(words.y & 2047u, words.y >> 11 & 2047u, words.y >> 22) / kRootSteps;
    surface.base = root * root;
    surface.roughness = float(words.z & 16383u) / kRoughnessSteps;
    surface.metallic = float(words.z >> 14 & 1023u) / kMetallicSteps;
    vec2 flat_normal = vec2(words.w & 4095u, words.w >> 12 & 4095u) / kFlatNormalSteps;
    surface.flat_normal = octahedralDirection(flat_normal * 2.0 - 1.0);
    surface.error = unpackHalf2x16(words.z >> 24 | (words.w & ~kReceivesBit) >> 24 << 8).x;
    surface.receives = (words.w & kReceivesBit) != 0u;
    return surface;
}
