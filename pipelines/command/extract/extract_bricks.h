// hearth extract --part bricks: writes the solid voxels of the brick grid as CSV.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <string>

namespace hearth::command
{

/// Write the grid of a pack or bricks part as CSV, a row for each face of each solid voxel, ordered by brick,
/// voxel and face (x- to z+):
/// x,y,z,face,opacity,albedo_r,...,normal_x,...,emissive_r,...,lighting_r,...,lighting_b. A voxel without
/// faces has one row, with face none and zeros behind its opacity. x, y, z count voxels; colours are linear
/// Rec.709; emission and lighting are radiance.
/// errors: chunk_missing if the file has no bricks; those of openContainer; cannot_write.
Status extractBricks(const std::string& path, const std::string& output);

} // namespace hearth::command
