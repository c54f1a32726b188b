// Push constants of all pipelines, a struct for each block. One source for C++ and GLSL: a shader declares
// layout(push_constant) uniform Push { CullPush push; }. Members are uints and floats, whose offsets are the
// same in std430 and C++.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_PUSH_CONSTANTS_H
#define HEARTH_SHARED_PUSH_CONSTANTS_H

#include "formats/gpu_shared/language.h"

HEARTH_SHARED_BEGIN

/// Instance culling, and skinning of vertices.
struct PhasePush
{
    uint phase; ///< kPhase*, here and below
};

/// Cluster culling.
struct CullPush
{
    uint first_item;
    uint item_count;
    uint phase;
};

struct ScanBlocksPush
{
    uint item_count;
};

struct ScanTotalsPush
{
    uint block_count;
    uint slot_capacity;
    uint phase;
};

struct EmitVisiblePush
{
    uint item_count;
    uint slot_capacity;
};

struct EmitDrawsPush
{
    uint bin_count;
    uint item_count;
    uint block_count;
    uint slot_capacity;
    uint phase;
};

struct WordCopyPush
{
    uint first_region;
};

struct PageRequestPush
{
    uint first_item;
    uint item_count;
    uint first_material;   ///< of the requests: behind those of the pages
    uint default_material; ///< row of clusters without a material
};

struct CullStatisticsPush
{
    uint first_item;
    uint item_count;
    uint instance_count; ///< 0 where the other pass counts them
};

/// Rectangle of pixels whose triangles are found.
struct PickPush
{
    uint x;
    uint y;
    uint width;
    uint height;
};

/// Motion vector of what was behind the eye, in both components, and the largest of others in one. Pixels,
/// exact in half floats.
HEARTH_CONSTANT float kMotionUnseen = 32768.0f;
HEARTH_CONSTANT float kMaxMotion = 16384.0f;
/// Distance of the sky and of what is farther, metres: the largest half float.
HEARTH_CONSTANT float kMaxMotionDistance = 65504.0f;

/// Motion vectors: the frame before with the same targets.
struct MotionPush
{
    /// Row of its view; w: its shift, unless the row has it (not of orthographic views), less that of this
    /// frame, in halves of the image's width.
    Float4 clip_x;
    Float4 clip_y;       ///< w: the same downwards, in halves of its height
    Float4 clip_w;       ///< w: 1 for an orthographic view, else 0
    Float3 eye;          ///< world
    uint first_instance; ///< row of its instance 0
    uint pose_rows;      ///< from the rows of a pose to those that it had
    uint reserved0;
    uint reserved1;
    uint reserved2;
};

/// Temporal filter.
struct TemporalPush
{
    uint has_history; ///< 0: the frame stays as it is
};

/// Listing of proxies that cast shadows.
struct ListProxiesPush
{
    uint instance_count;
};

struct SkinningPlanPush
{
    uint bin_count;
    uint first_bin; ///< first bin of deformed clusters
    uint phase;
};

struct PyramidPush
{
    uint width; ///< pixels of the frame, here and below
    uint height;
};

/// Material tiles.
struct TilesPush
{
    uint width;
    uint height;
    uint draw_count; ///< the sky and the materials of the scene
};

/// Lists of lights.
struct LightListsPush
{
    uint writes;      ///< 0: counts the lights of each list, 1: writes their indices
    uint marked_only; ///< 1: cells have lists only where a pixel marks them
};

/// Visibility pass, overdraw view and shadow casters.
struct BinPush
{
    uint bin;
    uint light_row; ///< casters: row of the ShadowBlock
    uint map_index; ///< casters
    uint facing;    ///< casters: kCaster*, the winding of their front
};

/// Winding of the front of a bin's casters: counterclockwise, clockwise, or both sides are fronts.
HEARTH_CONSTANT uint kCasterCounterclockwise = 0u;
HEARTH_CONSTANT uint kCasterClockwise = 1u;
HEARTH_CONSTANT uint kCasterDoubleSided = 2u;

/// Value of ShadingPush::material: all materials, but not the sky.
HEARTH_CONSTANT uint kEverySurface = 0xFFFFFFFFu;

/// Depth of a material's number: exact in the 24 bits of a float's fraction.
HEARTH_CONSTANT float kMaterialDepthStep = 1.52587890625e-5f;

/// Material marks, shading and debug views.
struct ShadingPush
{
    float depth;   ///< at which the area is drawn: kMaterialDepthStep for each number
    uint material; ///< number of the area's material, 0 for the sky; of the stencil, the bit that is marked
    uint debug_view;
    float depth_scale;  ///< metres that the depth view shows as half brightness
    uint sky_occlusion; ///< skyOcclusionBits
    float exposure;     ///< factor of the radiance
    float filter_red;   ///< photo filter: its colour
    float filter_green;
    float filter_blue;
    float filter_density; ///< 0: no filter
};

/// Downsampling of bloom.
struct BloomDownPush
{
    uint dims_fireflies; ///< 1: bright texels of the source weigh less, for the first level
};

/// Upsampling of bloom.
struct BloomUpPush
{
    float share; ///< of the coarser levels; the rest is the level's own
};

/// Automatic exposure.
struct ExposurePush
{
    float key;        ///< luminance that the mean of the frame gets
    float share;      ///< by which the exposure goes from the last one to that
    uint has_light;   ///< 1: the last frame has left its last level of bloom
    uint has_history; ///< 1: the last frame has left its exposure
};

/// Final pass.
struct FinalPush
{
    float width; ///< pixels of the finished image
    float height;
    float exposure; ///< as ShadingPush, as the next four
    float filter_red;
    float filter_green;
    float filter_blue;
    float filter_density;
    float bloom_strength; ///< share of the bloom, or factor
    uint adds_bloom;      ///< 1: the bloom is added; 0: it replaces a share of the colour
    uint shows_data;      ///< 1: the image has display colours already, of a debug view
};

HEARTH_SHARED_END

#endif
