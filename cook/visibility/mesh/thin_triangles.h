// Triangles that are all but a line break the regulariser of the fit: they are collapsed, flipped or dropped.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::visibility
{

struct ThinStatistics
{
    uint32_t degenerate = 0; ///< triangles with two equal corners, before any was collapsed
    uint32_t duplicate = 0;  ///< with the corners of another, however oriented
    uint32_t collapsed = 0;  ///< short edges that became a vertex
    uint32_t flipped = 0;    ///< long edges that were turned to the corner beside them
    uint32_t dropped = 0;    ///< thin ones that neither helped; where they were is a hole
};

struct CleanTriangles
{
    std::vector<uint32_t> indices; ///< of what is left, in the order of the source
    std::vector<uint32_t> source; ///< for each the triangle of the source that is the same but for collapses,
                                  ///< or kNowhere where an edge was flipped
    std::vector<uint32_t> kept_of_source; ///< for each of the source, what has its three corners, or kNowhere
    std::vector<uint32_t> vertex_of_vertex; ///< what each vertex was collapsed into; most are themselves
    ThinStatistics statistics;
};

/// No triangle that is left is lower than `thinness` times its longest edge, no two have the same three vertices, and
/// none names a vertex twice. Short edges of thin triangles are collapsed, to the vertex with the lower index; where
/// a corner lies beside the middle of the longest edge, that edge is flipped if it has one other triangle and the two
/// become less thin; what is still thin is dropped.
/// indices   three for each triangle
/// thinness  least height by longest edge; 0: only duplicates and those that name a vertex twice go
CleanTriangles removeThinTriangles(std::span<const Float3> positions, std::span<const uint32_t> indices,
                                   double thinness);

} // namespace hearth::visibility
