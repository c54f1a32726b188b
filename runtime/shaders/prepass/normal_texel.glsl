// Surface of a pixel as sums of light need it: normal and roughness, and what keeps shadow maps from
// shadowing the surface itself. Shaders that include it may define one of two layouts that leave the latter
// out (S. Yeung, "Light pre-pass renderer on iPhone", 2012):
//   HEARTH_JOINED_SUMS                           his second one: A2B10G10R10, with the depth of the scene
//   HEARTH_JOINED_SUMS and HEARTH_ENCODED_DEPTH  his first one: halves, one of them the depth in metres
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/shaders/scene/directions.glsl"

struct StoredNormal
{
    vec3 normal; // of LitSurface, as the others
    vec3 flat_normal;
    float roughness;
    float error;
    bool receives;
};

#ifdef HEARTH_JOINED_SUMS
#define NormalTexel vec4
#define NormalTexture sampler2D
#define NormalInput subpassInput

// Halves and ten bits hold points of the octahedron from 0 to 1 alike.
vec2 packDirection(vec3 direction) { return octahedralPoint(direction) * 0.5 + 0.5; }

vec3 unpackDirection(vec2 point) { return octahedralDirection(point * 2.0 - 1.0); }

#ifdef HEARTH_ENCODED_DEPTH
// depth  metres along the view, above 0
vec4 packNormal(StoredNormal stored, float depth)
{
    // roughness is above 0
    return vec4(min(depth, 65504.0), packDirection(stored.normal), stored.receives ? -stored.roughness : stored.roughness);
}

bool isSurface(vec4 texel) { return texel.x > 0.0; }

StoredNormal unpackNormal(vec4 texel)
{
    vec3 normal = unpackDirection(texel.yz);
    return StoredNormal(normal, normal, abs(texel.w), 0.0, texel.w < 0.0);
}
#else
// one of the four values of the last channel, whose 0 is no surface
const float kReceiver = 1.0 / 3.0;

vec4 packNormal(StoredNormal stored, float depth)
{
    return vec4(packDirection(stored.normal), stored.roughness, stored.receives ? kReceiver : 1.0);
}

bool isSurface(vec4 texel) { return texel.w > 0.0; }

StoredNormal unpackNormal(vec4 texel)
{
    vec3 normal = unpackDirection(texel.xy);
    return StoredNormal(normal, normal, texel.z, 0.0, texel.w < 0.5);
}
#endif

#else
#define NormalTexel uvec2
#define NormalTexture usampler2D
#define NormalInput usubpassInput

const float kMinStoredRoughness = 0.045; // clampRoughness() returns no less
const float kRoughnessCodes = 1022.0; // 1 to 1023: 0 is no surface
const float kErrorsPerOctave = 4.0;
const float kMinErrorExponent = -20.0;
const float kAcrossCodes = 63.0;

// Codes of 10 bits are as far apart as roughnesses in proportion, since so are highlights: 0.3 %.
uint roughnessCode(float roughness)
{
    float octaves = log2(roughness / kMinStoredRoughness) / -log2(kMinStoredRoughness);
    return 1u + uint(round(clamp(octaves, 0.0, 1.0) * kRoughnessCodes));
}

float codedRoughness(uint code)
{
    return kMinStoredRoughness * pow(kMinStoredRoughness, -(float(code) - 1.0) / kRoughnessCodes);
}

// Errors grow by up to 19 %, and are a bound still: 7 bits from a thousandth of a millimetre to 3 km.
// 0: none.
uint errorCode(float error)
{
    if (error <= 0.0)
        return 0u;
    return uint(clamp(ceil((log2(error) - kMinErrorExponent) * kErrorsPerOctave), 0.0, 126.0)) + 1u;
}

float codedError(uint code)
{
    return code == 0u ? 0.0 : exp2((float(code) - 1.0) / kErrorsPerOctave + kMinErrorExponent);
}

// Direction within 90 degrees of a normal, in 7 bits for each axis across it. Most triangles lie nearly as
// the surface does that they stand for: codes are the closer, the nearer the direction is to the normal.
uvec2 directionCode(vec3 direction, vec3 normal)
{
    vec3 x, y;
    axesAcross(normal, x, y);
    vec2 across = vec2(dot(direction, x), dot(direction, y));
    return uvec2(round((sign(across) * sqrt(abs(across)) + 1.0) * kAcrossCodes));
}

vec3 codedDirection(uvec2 code, vec3 normal)
{
    vec3 x, y;
    axesAcross(normal, x, y);
    vec2 root = vec2(code) / kAcrossCodes - 1.0;
    vec2 across = root * abs(root);
    return normalize(across.x * x + across.y * y + sqrt(max(1.0 - dot(across, across), 0.0)) * normal);
}

// The normal has 16 + 16 bits.
uvec2 packNormal(StoredNormal stored, float depth)
{
    uint normal = packSnorm2x16(octahedralPoint(stored.normal));
    uvec2 flat_normal = directionCode(stored.flat_normal, octahedralDirection(unpackSnorm2x16(normal)));
    return uvec2(normal, roughnessCode(stored.roughness) | errorCode(stored.error) << 10 |
                             (stored.receives ? 1u << 17 : 0u) | flat_normal.x << 18 | flat_normal.y << 25);
}

bool isSurface(uvec2 texel) { return texel.y != 0u; }

StoredNormal unpackNormal(uvec2 texel)
{
    vec3 normal = octahedralDirection(unpackSnorm2x16(texel.x));
    vec3 flat_normal = codedDirection(uvec2(texel.y >> 18 & 127u, texel.y >> 25), normal);
    return StoredNormal(normal, flat_normal, codedRoughness(texel.y & 1023u),
                        codedError(texel.y >> 10 & 127u), (texel.y >> 17 & 1u) != 0u);
}

#endif
