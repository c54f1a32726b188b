// Lists the voxel and the side of each face of a grid. The tables store only the inverse mapping.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/brick_march.h"

#include <vector>

namespace hearth::bricks
{

struct FaceLocation
{
    uint16_t x, y, z; ///< voxel coordinates
    uint16_t side;    ///< 0 to kVoxelFaces - 1
};

/// Return the voxel and side of all faces, in face order.
std::vector<FaceLocation> faceLocations(const shared::BrickMasks& masks);

} // namespace hearth::bricks
