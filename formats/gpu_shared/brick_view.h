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

struct BrickView
{
    BrickGrid grid;
    uint face_count;
    uint first_brick;  ///< first of the bricks whose faces the frame lights
    uint slice_bricks; ///< number of these bricks
    uint slice_faces;  ///< number of their faces, which are contiguous
    uint emission_box_count;
    uint light_rays; ///< rays of one face
    uint reserved0;
    uint reserved1;
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
