// hearth extract --part bricks: the solid voxels of the grid as plain numbers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <string>

namespace hearth::command
{

/// Write the grid of a pack or bricks part as CSV, a row for each face of each solid voxel, brick by brick in their order,
/// voxel by voxel, x- to z+: x,y,z,face,opacity,albedo_r,...,normal_x,...,emissive_r,...,lighting_r,...,lighting_b. A
/// voxel without faces has one row, face none, with zeros behind its opacity. x, y, z count voxels; colours are linear
/// Rec.709, emission and lighting radiance.
/// errors: chunk_missing where the file has no bricks; those of openContainer; cannot_write.
Status extractBricks(const std::string& path, const std::string& output);

} // namespace hearth::command
