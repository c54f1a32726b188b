// Marches rays from a CSV file through a brick grid, for external checks.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "formats/gpu_shared/brick_march.h"

#include <string>
#include <string_view>
#include <vector>

namespace hearth::bricks
{

struct MarchRay
{
    Float3 origin;    ///< metres, world space
    Float3 direction; ///< unit length
};

/// Read CSV text. The first line is origin_x,origin_y,origin_z,direction_x,direction_y,direction_z; all
/// others have six numbers each. Directions of any length above 0 are normalized.
/// errors: table_rows, naming `name` and the line.
Result<std::vector<MarchRay>> readRayCsv(std::string_view text, const std::string& name);

/// March the rays and return CSV text: "hit,x,y,z,face,t" and a line for each ray, in their order. A hit is
/// 1, the first solid voxel, the face by which the ray enters it (x- to z+; none where it starts inside) and
/// the distance in metres, with enough digits to restore a float. A miss is "0,,,,,".
std::string marchRaysToCsv(const shared::BrickMasks& bricks, const std::vector<MarchRay>& rays);

/// Read rays from a file, march them and write the results.
/// input   a pack or a part with bricks
/// output  path, or - for standard output
/// errors: chunk_missing where the input has no bricks; errors of opening and checking it; input_missing;
/// errors of readRayCsv; cannot_write.
Status marchCsvFile(const std::string& input, const std::string& rays, const std::string& output);

} // namespace hearth::bricks
