// What a frame tells the passes over bricks, written once for C++ and GLSL (std140).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_BRICK_VIEW_H
#define HEARTH_SHARED_BRICK_VIEW_H

#include "formats/gpu_shared/bricks.h"

HEARTH_SHARED_BEGIN

/// Boxes of a frame in which emission is not what the pack says.
HEARTH_CONSTANT uint kMaxEmissionBoxes = 8;

/// Faces of voxels whose middle lies in the box shine `factor` times as bright.
struct EmissionBox
{
    Float3 least; ///< voxels from the grid's origin
    float factor;
    Float3 most;
    float reserved;
};

struct BrickView
{
    BrickGrid grid;
    uint face_count;
    uint first_brick;  ///< of those whose faces the frame lights
    uint share_bricks; ///< so many
    uint share_faces;  ///< of these, one behind the other
    uint emission_box_count;
    uint light_rays; ///< of a face
    uint reserved0;
    uint reserved1;
    EmissionBox emission_boxes[kMaxEmissionBoxes];
};

/// Where a brick lies: its first voxel.
struct BrickPlace
{
    uint xy; ///< x, y << 16
    uint z;
};

HEARTH_SHARED_END

#ifdef __cplusplus
static_assert(sizeof(hearth::shared::BrickView) == 64 + 32 * hearth::shared::kMaxEmissionBoxes);
#endif

#endif
