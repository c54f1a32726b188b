// Light that is gathered for the picture: once for each tile of 8 x 8 pixels, at one of its points. What the passes that
// find the points, gather and shade agree on, written once for C++ and GLSL. See runtime/gpu/README.md, "The light of bricks".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_GATHER_H
#define HEARTH_SHARED_GATHER_H

#include "formats/gpu_shared/language.h"

// The light that falls on a point is kept as cosine-weighted moments of the radiance over the hemisphere of its normal n:
// the mean m0, which is irradiance / pi, and the mean of radiance times direction, of which the part across n is m1. For
// radiance that is linear in the direction, L0 + dot(L1, d), the part of L1 across n is 4 m1, so that irradiance / pi at
// another normal is m0 + 8 / 3 dot(m1, normal) (the part of L1 along n is taken for none: what it does at n itself is in m0).
//
// Mirror images are kept as the means of two GGX lobes about the direction of the mirror: gather_lobe.h.

HEARTH_SHARED_BEGIN

/// Side of a tile.
HEARTH_CONSTANT uint kGatherPixels = 8;

/// Rays of a point a frame, and frames after which their directions come again.
HEARTH_CONSTANT uint kGatherRays = 16;
HEARTH_CONSTANT uint kGatherFrames = 16;

/// Rays of a lobe a frame; there are two, and each ray of the hemisphere has one of a lobe beside it.
HEARTH_CONSTANT uint kGatherLobeRays = 8;

/// Roughness of the lobes. Half of the sharp one lies within .08 of the mirror's direction, which is as wide as a voxel at a
/// distance of 12 of its sizes: one that is sharper shows voxels.
HEARTH_CONSTANT float kGatherSharp = 0.2f;
HEARTH_CONSTANT float kGatherWide = 0.55f;

/// Frames whose mean the lobes show: they follow the eye.
HEARTH_CONSTANT float kGatherLobeMemory = 8.0f;

/// Points of a workgroup.
HEARTH_CONSTANT uint kGatherGroupPoints = 4;

/// Tiles to each side that are smoothed over.
HEARTH_CONSTANT int kGatherReach = 3;

/// Frames whose mean a point shows, about: at rest, and after light has changed.
HEARTH_CONSTANT float kGatherMemory = 32.0f;
HEARTH_CONSTANT float kGatherShortMemory = 4.0f;

/// What a tile knows.
struct GatherPoint
{
    Float3 position; ///< relative to the eye of its frame
    float count;   ///< frames that it has gathered, up to the memory; 0: its point is shut in between bricks
    Float3 normal; ///< unit, world axes
    float sky;     ///< share of its rays that met no brick
    Float3 mean;   ///< m0, linear colour
    float seen;    ///< 0: the tile shows nothing but sky, 1: a surface
    Float4 red;    ///< m1 of each colour, world axes; w: radiance of the sharp lobe
    Float4 green;
    Float4 blue;
    Float3 wide; ///< radiance of the wide lobe
    float reserved;
};

/// The tiles of a frame, and how those of the frame before were seen.
struct GatherView
{
    Float4 clip_x; ///< of the frame before, as FrameView
    Float4 clip_y;
    Float4 clip_w;
    Float3 eye_step; ///< from the eye of the frame before to this one's, metres
    float memory;    ///< frames: kGatherMemory, or fewer
    Float3 eye;      ///< from the grid's origin, metres
    uint frame;      ///< counts up
    uint tiles_x;
    uint tiles_y;
    uint known;       ///< 0: nothing is known of a frame before
    float tile_angle; ///< metres that a tile covers at a distance of one metre
};

/// How much of the sharp lobe, of the wide one and of the cosine's mean a surface shows.
struct GatherLobeShares
{
    float sharp;
    float wide;
    float cosine;
};

/// Straight between kGatherSharp, kGatherWide and 1, where a lobe is next to the cosine's. Below kGatherSharp all is the
/// sharp lobe.
/// roughness  perceptual
HEARTH_FUNCTION GatherLobeShares gatherLobeShares(float roughness)
{
    float to_wide = (roughness - kGatherSharp) / (kGatherWide - kGatherSharp);
    float to_cosine = (roughness - kGatherWide) / (1.0f - kGatherWide);
    GatherLobeShares shares;
    shares.cosine = min(max(to_cosine, 0.0f), 1.0f);
    shares.sharp = 1.0f - min(max(to_wide, 0.0f), 1.0f);
    shares.wide = 1.0f - shares.sharp - shares.cosine;
    return shares;
}

HEARTH_FUNCTION uint gatherTiles(uint pixels)
{
    return (pixels + kGatherPixels - 1u) / kGatherPixels;
}

HEARTH_SHARED_END

#ifdef __cplusplus
// sizes as std430 and std140 lay them out
static_assert(sizeof(hearth::shared::GatherPoint) == 112);
static_assert(sizeof(hearth::shared::GatherView) == 96);
#endif

#endif
