// Final gathering of global illumination: light is gathered once for each tile of 8 x 8 pixels, at one point
// of the tile. Defines the data that the gather and shading passes share. One source for C++ and GLSL. See
// runtime/gpu/README.md.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_GATHER_H
#define HEARTH_SHARED_GATHER_H

#include "formats/gpu_shared/language.h"
#include "formats/gpu_shared/precision.h"

// Incident light at a point is stored as cosine-weighted moments of the radiance over the hemisphere of its
// normal n: the mean m0, which is irradiance / pi, and m1, the component across n of the mean of radiance
// times direction. For a radiance that is linear in the direction, L0 + dot(L1, d), the component of L1
// across n is 4 m1, so irradiance / pi at another normal is m0 + 8 / 3 dot(m1, normal). (The component of L1
// along n is taken as 0: its effect at n itself is in m0.)
//
// Reflections are stored as the means of two GGX lobes about the mirror direction: gather_lobe.h.

HEARTH_SHARED_BEGIN

/// Side of a tile, in pixels.
HEARTH_CONSTANT uint kGatherTilePixels = 8;

/// Rays of a point in one frame, and number of frames after which their directions repeat.
HEARTH_CONSTANT uint kGatherRays = 16;
HEARTH_CONSTANT uint kGatherFrames = 16;

/// Rays of a lobe in one frame. There are two lobes; each hemisphere ray has one lobe ray beside it.
HEARTH_CONSTANT uint kGatherLobeRays = 8;

/// Roughness of the lobes. Half of the sharp lobe lies within .08 of the mirror direction, as wide as a voxel
/// at a distance of 12 voxels: a sharper lobe would show voxels.
HEARTH_CONSTANT float kGatherSharpRoughness = 0.2f;
HEARTH_CONSTANT float kGatherWideRoughness = 0.55f;

/// Frames that the lobes average, about: short, because lobes depend on the eye.
HEARTH_CONSTANT float kGatherLobeHistoryFrames = 8.0f;

/// Side, in tiles, of the square of a workgroup that has a thread for each tile.
HEARTH_CONSTANT uint kGatherGroupTiles = 8;

/// Points of a workgroup that traces rays.
HEARTH_CONSTANT uint kGatherGroupPoints = 4;

/// Radius of the smoothing filter, in tiles.
HEARTH_CONSTANT int kGatherFilterRadius = 3;

/// Frames that a point averages, about: at rest, and after light has changed.
HEARTH_CONSTANT float kGatherHistoryFrames = 32.0f;
HEARTH_CONSTANT float kGatherShortHistoryFrames = 4.0f;

/// Gathered light of a tile.
struct GatherPoint
{
    Float3 position; ///< relative to the eye of its frame
    float count;   ///< frames gathered, up to GatherView::history_frames; 0: its point is enclosed by bricks
    Float3 normal; ///< unit, world axes
    float sky;     ///< fraction of its rays that met no brick
    Float3 mean;   ///< m0, linear colour
    float has_surface; ///< 0: the tile contains only sky, 1: a surface
    Float4 red;        ///< m1 of each colour, world axes; w: radiance of the sharp lobe
    Float4 green;
    Float4 blue;
    Float3 wide; ///< radiance of the wide lobe
    float reserved;
};

/// View of the tiles of a frame, and of the frame before.
struct GatherView
{
    Float4 clip_x; ///< matrix of the frame before, as FrameView
    Float4 clip_y;
    Float4 clip_w;
    Float3 eye_step;      ///< from the eye of the frame before to this frame's eye, metres
    float history_frames; ///< kGatherHistoryFrames, or fewer frames
    Float3 eye;           ///< from the grid's origin, metres
    uint frame;           ///< frame counter
    uint tiles_x;
    uint tiles_y;
    uint has_history; ///< 0: there is no frame before
    float tile_angle; ///< metres that a tile covers at a distance of one metre
    Float3 reserved;
    float tile_size; ///< metres that a tile of an orthographic view covers; else 0
};

/// Return the metres that a tile covers.
/// distance  from the eye, metres
HEARTH_FUNCTION float gatherTileSize(HEARTH_IN(GatherView) view, float distance)
{
    return view.tile_size > 0.0f ? view.tile_size : distance * view.tile_angle;
}

/// Weights of the sharp lobe, the wide lobe and the cosine-weighted mean in a surface's reflection.
struct GatherLobeShares
{
    Half sharp;
    Half wide;
    Half cosine;
};

/// Return the weights, linear between kGatherSharpRoughness, kGatherWideRoughness and 1, where a lobe is
/// close to the cosine's. Below kGatherSharpRoughness the sharp lobe has all the weight.
/// roughness  perceptual
HEARTH_FUNCTION GatherLobeShares gatherLobeShares(Half roughness)
{
    Half to_wide = (roughness - kGatherSharpRoughness) / (kGatherWideRoughness - kGatherSharpRoughness);
    Half to_cosine = (roughness - kGatherWideRoughness) / (1.0f - kGatherWideRoughness);
    GatherLobeShares shares;
    shares.cosine = min(max(to_cosine, 0.0f), 1.0f);
    shares.sharp = 1.0f - min(max(to_wide, 0.0f), 1.0f);
    shares.wide = 1.0f - shares.sharp - shares.cosine;
    return shares;
}

HEARTH_FUNCTION uint gatherTiles(uint pixels)
{
    return (pixels + kGatherTilePixels - 1u) / kGatherTilePixels;
}

HEARTH_SHARED_END

#ifdef __cplusplus
// sizes in std430 and std140 layout
static_assert(sizeof(hearth::shared::GatherPoint) == 112);
static_assert(sizeof(hearth::shared::GatherView) == 112);
#endif

#endif
