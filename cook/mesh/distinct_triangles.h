// Finds copies of triangles: searches visit all that lie over each other, and some trees cannot part them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::mesh
{

/// Find the triangles that are no copies of earlier ones, with the same corners in any order.
/// indices  three for each triangle
/// returns  numbers of triangles, ascending
std::vector<uint32_t> findDistinctTriangles(std::span<const uint32_t> indices);

/// Return the indices of some triangles.
std::vector<uint32_t> selectTriangles(std::span<const uint32_t> indices, std::span<const uint32_t> triangles);

} // namespace hearth::mesh
