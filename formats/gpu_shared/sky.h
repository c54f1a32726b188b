// The sky that lights every scene: a smooth gradient from ground over horizon to zenith, or an image. Its
// radiance from a direction, and its means over cones and lobes. One source for C++ and GLSL.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_SKY_H
#define HEARTH_SHARED_SKY_H

#include "formats/gpu_shared/language.h"
#include "formats/gpu_shared/precision.h"

#ifdef __cplusplus
#include <array>
#endif

// The radiance of the gradient depends on the height of the direction alone, the sine of its elevation. It is
//     ground + (horizon - ground) above + (zenith - horizon) above high,
// and the table has the means of both products over cones (formats/scene/sky_table.h).
//
// The image of a sky is its probe (formats/records/probe.h). Background and reflections sample the probe's
// cube map, the diffuse part takes its harmonics, and rays through bricks read a small cube of texels here:
// they are few, so a blurred sky gives them less noise. Everything that the sky lights reads skyRadiance
// here, or skyDiffuse or skyMirror of sky.glsl.

HEARTH_SHARED_BEGIN

/// Nodes of the table: heights of axes are columns, half-angles rows.
HEARTH_CONSTANT uint kSkyTableHeights = 128;
HEARTH_CONSTANT uint kSkyTableAngles = 16;

/// Texels of the image of a sky that rays read: panels of this side, in the order and orientation of a cube
/// map, in RGB9E5.
HEARTH_CONSTANT uint kSkyImageSide = 16;
HEARTH_CONSTANT uint kSkyImageTexels = 6 * 16 * 16;
HEARTH_CONSTANT uint kSkyHarmonics = 9; ///< degrees 0 to 2
/// Rows of 16 bytes that a sky image takes in the buffer of lights: texels, then harmonics of radiance.
/// Behind the first harmonic is the factor of the texels, behind the second one the number of sharp mips.
HEARTH_CONSTANT uint kSkyImageRows = 6 * 16 * 16 / 4 + 9;
HEARTH_CONSTANT uint kNoSkyImage = 0; ///< in place of the first row: the sky is the gradient

#ifdef __cplusplus
/// Image of a sky (formats/scene/sky_image.h).
struct SkyImage
{
    std::array<uint32_t, kSkyImageTexels> texels; ///< radiance over `factor`, in RGB9E5
    std::array<Float3, kSkyHarmonics> harmonics;  ///< of radiance, as shared::evaluateHarmonics
    float factor;                                 ///< of texels, here and in the cube map of the probe
    uint32_t sharp_mips;                          ///< of the cube map
};
#endif

/// Colours of the gradient, radiance, as in shared::Lighting; or an image.
struct Sky
{
    Float3 zenith;
    Float3 horizon;
    Float3 ground;
#ifdef __cplusplus
    const SkyImage* image = nullptr; ///< none: the gradient
#else
    uint image; ///< first row, or kNoSkyImage
#endif
};

#ifdef __cplusplus
inline bool hasSkyImage(const Sky& sky)
{
    return sky.image != nullptr;
}
inline uint skyImageTexel(const Sky& sky, uint index)
{
    return sky.image->texels[index];
}
inline float skyImageFactor(const Sky& sky)
{
    return sky.image->factor;
}
inline Float3 skyImageHarmonic(const Sky& sky, uint index)
{
    return sky.image->harmonics[index];
}
#else
bool hasSkyImage(Sky sky)
{
    return sky.image != kNoSkyImage;
}
// by scene/sky_rows.glsl
uint skyImageTexel(Sky sky, uint index);
float skyImageFactor(Sky sky);
vec3 skyImageHarmonic(Sky sky, uint index);
#endif

/// Return the colour of a texel of RGB9E5.
HEARTH_FUNCTION Float3 sharedExponentColor(uint word)
{
    // 2^(exponent - 15 - 9)
    float scale = floatFromBits(((word >> 27) + 103u) << 23);
    return Float3(float(word & 511u), float(word >> 9 & 511u), float(word >> 18 & 511u)) * scale;
}

/// Place of a direction in a cube: across / depth and down / depth run from -1 to 1, rightwards and
/// downwards.
struct CubePlace
{
    uint panel; ///< face, in the order of a cube map
    float across;
    float down;
    float depth; ///< above 0
};

/// Return the place of a direction.
/// direction  of any length but 0
/// source     Vulkan 1.3, section "Cube Map Face Selection"
HEARTH_FUNCTION CubePlace findCubePlace(Float3 direction)
{
    float x = abs(direction.x);
    float y = abs(direction.y);
    float z = abs(direction.z);
    bool is_z = z >= x && z >= y;
    bool is_y = !is_z && y >= x;
    float major = is_z ? direction.z : (is_y ? direction.y : direction.x);
    CubePlace place;
    place.panel = (is_z ? 4u : (is_y ? 2u : 0u)) + (major < 0.0f ? 1u : 0u);
    place.across = is_z ? (major < 0.0f ? -direction.x : direction.x)
                        : (is_y ? direction.x : (major < 0.0f ? direction.z : -direction.z));
    place.down = is_y ? (major < 0.0f ? -direction.z : direction.z) : -direction.y;
    place.depth = abs(major);
    return place;
}

/// Return the index of the texel of a sky image that a direction is in.
/// direction  of any length but 0
HEARTH_FUNCTION uint skyImageIndex(Float3 direction)
{
    CubePlace place = findCubePlace(direction);
    float scale = 0.5f * float(kSkyImageSide) / place.depth;
    float half_side = 0.5f * float(kSkyImageSide);
    float last = float(kSkyImageSide) - 1.0f;
    uint column = uint(min(max(place.across * scale + half_side, 0.0f), last));
    uint row = uint(min(max(place.down * scale + half_side, 0.0f), last));
    return (place.panel * kSkyImageSide + row) * kSkyImageSide + column;
}

HEARTH_FUNCTION float skySmoothstep(float from, float to, float x)
{
    float t = min(max((x - from) / (to - from), 0.0f), 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

/// Return how far a direction of this height is above the ground, [0, 1].
HEARTH_FUNCTION float skyAbove(float height)
{
    return skySmoothstep(-0.296f, 0.296f, height);
}

/// Return how far a direction of this height is from the horizon to the zenith, [0, 1].
HEARTH_FUNCTION float skyHigh(float height)
{
    return skySmoothstep(-0.2f, 1.0f, height);
}

/// Return the radiance from a direction.
/// direction  unit
HEARTH_FUNCTION Float3 skyRadiance(HEARTH_IN(Sky) sky, Float3 direction)
{
    if (hasSkyImage(sky))
        return sharedExponentColor(skyImageTexel(sky, skyImageIndex(direction))) * skyImageFactor(sky);
    Float3 above = sky.horizon + (sky.zenith - sky.horizon) * skyHigh(direction.y);
    return sky.ground + (above - sky.ground) * skyAbove(direction.y);
}

/// Harmonics of radiance, as shared::evaluateHarmonics.
struct RadianceHarmonics
{
    Half3 constant;
    Half3 linear_y;
    Half3 linear_x;
    Half3 linear_z;
    Half3 square_y;
    Half3 product_xy;
    Half3 product_yz;
    Half3 product_xz;
    Half3 difference;
};

/// Return the mean radiance over a cone by harmonics, at least 0: a cone keeps (1 + c) / 2 of degree 1
/// and c (1 + c) / 2 of degree 2. For wide cones, of which the diffuse part is one.
/// axis            as LightCone
/// cos_half_angle  c, [0, 1]
/// source          P.-P. Sloan, "Stupid spherical harmonics (SH) tricks", 2008, "Cone light source"
HEARTH_FUNCTION Half3 harmonicConeRadiance(HEARTH_IN(RadianceHarmonics) of, Half3 axis, Half cos_half_angle)
{
    Half x = axis.x;
    Half y = axis.y;
    Half z = axis.z;
    Half3 linear = of.linear_y * y + of.linear_x * x + of.linear_z * z;
    Half3 quadratic = of.square_y * (0.28867513f * (2.0f * y * y - x * x - z * z)) + of.product_xy * (x * y) +
                      of.product_yz * (y * z) + of.product_xz * (x * z) +
                      of.difference * (0.5f * (x * x - z * z));
    Half first = 0.5f * (1.0f + cos_half_angle);
    Half3 mean = of.constant * 0.28209479f + linear * (0.48860251f * first) +
                 quadratic * (1.09254843f * first * cos_half_angle);
    return Float3(max(mean.x, 0.0f), max(mean.y, 0.0f), max(mean.z, 0.0f));
}

/// Return the mean radiance of an image over a cone: harmonicConeRadiance.
HEARTH_FUNCTION Half3 skyImageConeRadiance(HEARTH_IN(Sky) sky, Half3 axis, Half cos_half_angle)
{
    RadianceHarmonics harmonics;
    harmonics.constant = skyImageHarmonic(sky, 0u);
    harmonics.linear_y = skyImageHarmonic(sky, 1u);
    harmonics.linear_x = skyImageHarmonic(sky, 2u);
    harmonics.linear_z = skyImageHarmonic(sky, 3u);
    harmonics.square_y = skyImageHarmonic(sky, 4u);
    harmonics.product_xy = skyImageHarmonic(sky, 5u);
    harmonics.product_yz = skyImageHarmonic(sky, 6u);
    harmonics.product_xz = skyImageHarmonic(sky, 7u);
    harmonics.difference = skyImageHarmonic(sky, 8u);
    return harmonicConeRadiance(harmonics, axis, cos_half_angle);
}

/// Return the mean radiance of the gradient over a cone.
/// means  of skyAbove (x) and skyAbove * skyHigh (y), as the table has them
HEARTH_FUNCTION Half3 skyMeanRadiance(HEARTH_IN(Sky) sky, Half2 means)
{
    Half3 ground = sky.ground;
    Half3 horizon = sky.horizon;
    Half3 zenith = sky.zenith;
    return ground + (horizon - ground) * means.x + (zenith - horizon) * means.y;
}

/// Return the coordinates of a lookup, each in [0, 1], the first node at 0, the last at 1.
/// height          of the cone's axis, [-1, 1]
/// cos_half_angle  [0, 1]
HEARTH_FUNCTION Half2 skyTableCoordinates(Half height, Half cos_half_angle)
{
    // linear in the half-angle, about
    return Float2(min(max(0.5f + 0.5f * height, 0.0f), 1.0f),
                  sqrt(min(max(1.0f - cos_half_angle, 0.0f), 1.0f)));
}

/// Return height (x) and cosine of the half-angle (y) of a node.
HEARTH_FUNCTION Float2 skyTableNode(uint column, uint row)
{
    float across = float(column) / float(kSkyTableHeights - 1u);
    float down = float(row) / float(kSkyTableAngles - 1u);
    return Float2(2.0f * across - 1.0f, 1.0f - down * down);
}

// ---- lobes in an image

// The mips of a probe are lobes seen along the normal, about the mirror direction. Seen from aside, a lobe is
// narrower across, its tail leans towards the normal, and masking takes what grazes the surface. So a lobe is
//     (1 - wide) mip(roughness', axis) + wide ((1 - even) diffuse + even mean),
// where diffuse is the mean by the cosine to the normal, and mean that over all directions. The four numbers
// were fitted to lobes of GGX with height-correlated masking, as harmonics of degree 12 with weights
// 1 / sqrt(1 + l^2): the rms error of roughness .4 to .8 is .03 to .22 of the lobe, seen at cosines of 1 to
// .1; one mip about the lobe's mean direction has .07 to .40 (tests/formats/sky_lobe_test.cpp). The wide part
// of smooth surfaces is less than the fit asks for: beside a sun it would fill what is dark.

struct SkyLobe
{
    Half turn;      ///< axis: (1 - turn) mirror direction + turn normal
    Half roughness; ///< of the mip
    Half wide;      ///< share of the wide part, [0, 1]
    Half even;      ///< share of the mean over all directions in the wide part
};

/// Return the parts of a lobe.
HEARTH_FUNCTION SkyLobe skyLobe(Half roughness, Half n_dot_v)
{
    Half alpha = roughness * roughness;
    Half aside = 1.0f - n_dot_v;
    Half rest = 1.0f - alpha;
    SkyLobe lobe;
    lobe.turn = min(alpha * aside * (0.3f + aside), 0.33f);
    lobe.roughness = roughness * (1.0f - aside * (0.28f + 0.36f * alpha));
    lobe.wide =
        min(alpha * alpha * (2.6f - 1.6f * alpha) + 1.6f * aside * aside * aside * alpha * rest * rest, 1.0f);
    lobe.even = alpha * alpha * alpha * (0.08f + 0.16f * aside * aside);
    return lobe;
}

HEARTH_SHARED_END

#endif
