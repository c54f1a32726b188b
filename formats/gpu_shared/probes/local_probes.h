// Probes within a scene, which light what is around them in place of the sky: their weights, the
// parallax of their reflections, and the atlas of their texels. One source for C++ and GLSL.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_LOCAL_PROBES_H
#define HEARTH_SHARED_LOCAL_PROBES_H

#include "formats/gpu_shared/language.h"
#include "formats/gpu_shared/sky.h"

// The texels of all probes lie in one image, the probes below each other: faces of roughness 0 side by
// side, below them those of the other mips from left to right. A face has a margin of one texel from
// the faces beside it, so that bilinear lookups pass the edges of the cube.
//
//     +X0 -X0 +Y0 -Y0 +Z0 -Z0
//     +X1 -X1 +Y1 -Y1 +Z1 -Z1 +X2 -X2 ...

HEARTH_SHARED_BEGIN

/// Most probes that are drawn: 3200 rows of the atlas.
HEARTH_CONSTANT uint kMaxLocalProbes = 32;

/// Rows of 16 bytes of a probe in the buffer of lights: LocalProbe, then nine harmonics.
HEARTH_CONSTANT uint kLocalProbeRows = 15;
HEARTH_CONSTANT uint kFirstProbeHarmonic = 6;

/// Least irradiance at a normal that light is divided by, as a share of the mean.
HEARTH_CONSTANT float kMinProbeIrradiance = 0.0625f;

struct LocalProbe
{
    Float3 position; ///< world, as the boxes
    /// Luminance of its mean irradiance, by which texels and harmonics are divided: times the weights of
    /// the lamps around it, of red, green and blue.
    float irradiance_red;
    Float3 box_min; ///< box on which its light is taken to lie
    uint atlas_row; ///< first row of its texels
    Float3 box_max;
    float fade; ///< metres, above 0
    Float3 influence_min;
    float irradiance_green;
    Float3 influence_max;
    float irradiance_blue;
    Float4 sky_share; ///< share of the sky that the probe sees: probeSkyShare
};

/// Return the weight of a probe at a position, [0, 1]: 0 on the faces of the box of influence and
/// outside.
HEARTH_FUNCTION float localProbeWeight(HEARTH_IN(LocalProbe) probe, Float3 position)
{
    Float3 low = position - probe.influence_min;
    Float3 high = probe.influence_max - position;
    float inside = min(min(min(low.x, high.x), min(low.y, high.y)), min(low.z, high.z));
    return min(max(inside / probe.fade, 0.0f), 1.0f);
}

/// Return the cosine-weighted share of the sky about a normal that the probe sees.
HEARTH_FUNCTION float probeSkyShare(HEARTH_IN(LocalProbe) probe, Float3 normal)
{
    float share = probe.sky_share.x * normal.x + probe.sky_share.y * normal.y + probe.sky_share.z * normal.z +
                  probe.sky_share.w;
    return min(max(share, 0.0f), 1.0f);
}

/// Return the distance at which a ray leaves the slab between two planes of an axis.
HEARTH_FUNCTION float slabExit(float from, float along, float low, float high)
{
    // a ray along the planes leaves through other ones
    return (along < 0.0f ? from - low : high - from) / max(abs(along), 1e-9f);
}

/// Return the direction in which a probe has the light that reaches a position from a direction: from
/// the probe to the point at which the ray leaves the box.
/// direction  unit
/// returns    of any length
HEARTH_FUNCTION Float3 correctParallax(HEARTH_IN(LocalProbe) probe, Float3 position, Float3 direction)
{
    float x = slabExit(position.x, direction.x, probe.box_min.x, probe.box_max.x);
    float y = slabExit(position.y, direction.y, probe.box_min.y, probe.box_max.y);
    float z = slabExit(position.z, direction.z, probe.box_min.z, probe.box_max.z);
    // at a position outside of the box, and at the probe itself on a face, the direction is what is
    // left
    float distance = max(min(x, min(y, z)), 1e-4f);
    return position + direction * distance - probe.position;
}

/// Return the factor from a probe's light, divided by its mean, to light at a surface.
/// irradiance  at the surface, before occlusion; luminance
/// own         of the probe at the surface's normal, over its mean; luminance. With the light of lamps if
///             the irradiance at the surface has it: at the probe the factor is then its mean irradiance
HEARTH_FUNCTION float localProbeFactor(float irradiance, float own)
{
    return irradiance / max(own, kMinProbeIrradiance);
}

/// Return the first column of a mip in the atlas; all mips but the first lie below it.
/// side  texels of an edge of the first mip's faces
HEARTH_FUNCTION uint probeMipColumn(uint side, uint mip)
{
    return mip == 0u ? 0u : 6u * (side - (side >> (mip - 1u)) + 2u * (mip - 1u));
}

/// Return the columns of the atlas: of the first row of faces, or of the second where that is wider.
HEARTH_FUNCTION uint probeAtlasColumns(uint side, uint mip_count)
{
    uint first = 6u * (side + 2u);
    uint second = probeMipColumn(side, mip_count);
    return second > first ? second : first;
}

/// Return the rows of a probe in the atlas.
HEARTH_FUNCTION uint probeAtlasRows(uint side)
{
    return side + 2u + (side >> 1) + 2u;
}

/// Return the point of the atlas, in texels, at which a mip of a probe has the light of a direction.
/// row  LocalProbe::atlas_row
HEARTH_FUNCTION Float2 probeAtlasPoint(HEARTH_IN(CubePlace) place, uint side, uint mip, uint row)
{
    uint own = side >> mip;
    float half_side = 0.5f * float(own);
    float scale = half_side / place.depth;
    uint left = probeMipColumn(side, mip) + place.panel * (own + 2u) + 1u;
    uint top = row + (mip == 0u ? 0u : side + 2u) + 1u;
    return Float2(float(left) + half_side + place.across * scale,
                  float(top) + half_side + place.down * scale);
}

HEARTH_SHARED_END

#ifdef __cplusplus
static_assert(sizeof(hearth::shared::LocalProbe) == 16 * hearth::shared::kFirstProbeHarmonic);
#endif

#endif
