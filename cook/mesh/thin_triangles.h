// Removes thin triangles (slivers) by edge collapse, edge flip or deletion: they break fits on the mesh, and
// are of no use for collision.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::mesh
{

struct ThinTriangleStatistics
{
    uint32_t degenerate = 0; ///< triangles with two equal corners, before any collapse
    uint32_t duplicate = 0;  ///< triangles with the corners of another, in any orientation
    uint32_t collapsed = 0;  ///< short edges collapsed into a vertex
    uint32_t flipped = 0;    ///< long edges flipped to the corner beside them
    uint32_t dropped = 0;    ///< thin triangles that neither could fix; they leave holes
};

struct CleanTriangles
{
    std::vector<uint32_t> indices; ///< remaining triangles, in the order of the source
    /// For each remaining triangle, the source triangle that it equals apart from collapses, or kInvalidIndex
    /// if an edge was flipped.
    std::vector<uint32_t> source;
    /// For each source triangle, the remaining triangle with its three corners, or kInvalidIndex.
    std::vector<uint32_t> remaining_of_source;
    std::vector<uint32_t> collapse_target; ///< target of each vertex's collapse; mostly the vertex itself
    ThinTriangleStatistics statistics;
};

/// Clean triangles so that none is lower than `thinness` times its longest edge, no two have the same three
/// vertices, and none names a vertex twice. Short edges of thin triangles are collapsed into the vertex with
/// the lower index. Where a corner lies beside the middle of the longest edge, that edge is flipped if
/// exactly one other triangle has it and both triangles become less thin. Triangles that are still thin are
/// dropped.
/// indices   three for each triangle
/// thinness  minimum height / longest edge; 0: remove only duplicates and triangles that name a vertex twice
CleanTriangles removeThinTriangles(std::span<const Float3> positions, std::span<const uint32_t> indices,
                                   double thinness);

} // namespace hearth::mesh
