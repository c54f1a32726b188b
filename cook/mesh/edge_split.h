// Splits the long edges of a surface, so that it can carry values that change along them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hearth::mesh
{

struct SplitSurface
{
    std::vector<Float3> positions;         ///< those of the surface, then middles of edges
    std::vector<uint32_t> indices;         ///< three for each triangle
    std::vector<uint32_t> source_triangle; ///< for each triangle, the one of the surface that it is a part of
};

/// Split edges at their middles until none is longer than `max_length`. Triangles that share an edge share
/// its parts, so that closed surfaces stay closed. A triangle becomes two, three or four in each round.
/// positions      finite
/// indices        three for each triangle, in range
/// max_length     > 0
/// max_triangles  of the result
/// returns        nothing if there would be more
std::optional<SplitSurface> splitLongEdges(std::span<const Float3> positions,
                                           std::span<const uint32_t> indices, float max_length,
                                           size_t max_triangles);

} // namespace hearth::mesh
