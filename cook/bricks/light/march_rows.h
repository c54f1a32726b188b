// Marches rows of rays through a grid of bricks, for checking from outside.
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
    Float3 direction; ///< unit
};

/// Read text whose first line is origin_x,origin_y,origin_z,direction_x,direction_y,direction_z and whose others have six
/// numbers each. Directions of any length above 0 are made unit.
/// errors: table_rows, naming `name` and the line.
Result<std::vector<MarchRay>> readRays(std::string_view text, const std::string& name);

/// "hit,x,y,z,face,t" and a line for each ray, in their order: 1, the first solid voxel, the face by which the ray enters it
/// (x- to z+; none where it starts inside) and the metres to there, in as many digits as floats need; or "0,,,,,".
std::string marchRows(const shared::BrickMasks& bricks, const std::vector<MarchRay>& rays);

/// Both, with files: `input` is a pack or a part with bricks, `output` may be - for standard output.
/// errors: chunk_missing where the input has no bricks; those of opening and checking it; input_missing; those of readRays;
/// cannot_write.
Status marchFile(const std::string& input, const std::string& rays, const std::string& output);

} // namespace hearth::bricks
