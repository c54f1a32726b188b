// Which voxel and side each face of a grid belongs to: what the tables only say the other way round.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/brick_march.h"

#include <vector>

namespace hearth::bricks
{

struct FacePlace
{
    uint16_t x, y, z; ///< voxel
    uint16_t side;    ///< of kVoxelFaces
};

/// Of all faces, in their order.
std::vector<FacePlace> facePlaces(const shared::BrickMasks& masks);

} // namespace hearth::bricks
