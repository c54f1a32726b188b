// Uniform block of the passes over bricks (std140). One source for C++ and GLSL.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_BRICK_VIEW_H
#define HEARTH_SHARED_BRICK_VIEW_H

#include "formats/gpu_shared/bricks.h"

HEARTH_SHARED_BEGIN

/// Maximum number of boxes in a frame that scale emission.
HEARTH_CONSTANT uint kMaxEmissionBoxes = 8;

/// Box that scales the emission of all faces of voxels with their middle inside by `factor`.
struct EmissionBox
{
    Float3 box_min; ///< lower corner, voxels from the grid's origin
    float factor;
    Float3 box_max;
    float reserved;
};

/// Parts of the light of faces: that of the passes over bricks, and that of baked lamps, by their weights.
/// The buffer has a shared::BrickLight of each face for the former, then a word of E5B9G9R9 of each for
/// the latter.
HEARTH_CONSTANT uint kLiveFaceLight = 1u;
HEARTH_CONSTANT uint kBakedFaceLight = 2u;

struct BrickView
{
    BrickGrid grid;
    uint face_count;
    uint first_brick;  ///< first of the bricks whose faces the frame lights
    uint slice_bricks; ///< number of these bricks
    uint slice_faces;  ///< number of their faces, which are contiguous
    uint emission_box_count;
    uint light_rays;   ///< rays of one face
    uint light_parts;  ///< bits kLiveFaceLight, kBakedFaceLight: of the light of a face
    float baked_scale; ///< radiance is the baked colour times it
    EmissionBox emission_boxes[kMaxEmissionBoxes];
};

/// Faces that a workgroup lights, one a thread.
HEARTH_CONSTANT uint kGroupFaces = 64;

/// Location of a brick: its first voxel.
struct BrickLocation
{
    uint xy; ///< x, y << 16
    uint z;
};

HEARTH_SHARED_END

#ifdef __cplusplus
static_assert(sizeof(hearth::shared::BrickView) == 64 + 32 * hearth::shared::kMaxEmissionBoxes);
#endif

#endif
