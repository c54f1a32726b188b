// Kinds of findings about the topology of a mesh: names, advice, and colours in PLY files.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace hearth::command
{

struct FindingKind
{
    std::string_view key;           ///< in JSON
    std::string_view words;         ///< in text
    std::string_view advice;        ///< what it is, what it does, and the remedy
    std::array<uint8_t, 3> color{}; ///< in PLY files
};

/// Names of the kinds: indices of findingKinds(), the worst first.
enum class Finding : uint8_t
{
    flipped_shells,
    inconsistent_edges,
    one_sided_shells,
    non_manifold_edges,
    self_intersections,
    non_manifold_vertices,
    t_junctions,
    doubled_triangles,
    boundary_loops,
    zero_area_triangles,
    duplicate_vertices,
    unreferenced_vertices,
};

std::span<const FindingKind> findingKinds();

inline const FindingKind& describeFinding(Finding finding)
{
    return findingKinds()[static_cast<size_t>(finding)];
}

} // namespace hearth::command
