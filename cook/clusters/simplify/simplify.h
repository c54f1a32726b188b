// Simplifies one group by edge collapses, without changing its border with other groups.
// See cook/clusters/README.md, "Simplifying".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/simplify/placement.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace hearth::clusters
{

/// Target of a position whose island was removed.
inline constexpr PositionId kPruned = kInvalid;

/// Result of simplifying a group.
struct SimplifiedGroup
{
    CornerVector<WedgeId> corners;            ///< wedges of the group's mesh, for the remaining triangles
    IdVector<TriangleId, uint32_t> materials; ///< material of each remaining triangle
    /// For each remaining triangle, the triangle of the group that it was.
    IdVector<TriangleId, TriangleId> source_triangle;
    /// Target of each position: itself, another, or kPruned.
    IdVector<PositionId, PositionId> target_of_position;
    Placement placement;     ///< positions and attributes of the remaining positions
    bool permissive = false; ///< attributes jump across a seam
    bool pruned = false;     ///< whole islands were removed
    bool merged = false;     ///< positions were merged by cells

    size_t triangleCount() const { return corners.triangleCount(); }
};

/// Alternative stop criterion: where collapses begin to cost more than `cost`, at the next lower number of
/// full clusters.
struct CostStop
{
    double cost = 0;          ///< quadric error, object space: area times squared distance
    size_t min_triangles = 1; ///< triangles that stay whatever they cost
    size_t max_triangles = 1; ///< triangles that may stay
};

/// Cost and result of a collapse.
struct CollapseStep
{
    double cost; ///< as in CostStop; at least that of earlier collapses
    size_t triangles;
};

/// Collapse edges, cheapest first by quadric error, until `target_triangles` are left or no collapse is
/// valid. Invariants:
/// - locked positions stay;
/// - every wedge of the removed position maps to a wedge of the target along their common edge, so that
///   attributes and materials do not jump (unless `permissive`: then wedges without such an edge take the
///   nearest attributes). Wedges that differ only in the normal from one with such an edge need none: hard
///   edges cost their change;
/// - open borders, and edges of more than two triangles, only shorten along themselves;
/// - no triangle flips, no two sheets are joined (link condition), no island disappears.
/// Collapse targets are then moved to where the quadrics are minimal, with their attributes. If the target is
/// not reached, whole islands are removed, the smallest first (`pruned`); one triangle always stays.
/// max_triangles  with more than these nothing is gained: attributes may jump and islands are removed to
///                 avoid it
/// stop            where collapses end; `target_triangles` then only applies to groups that need jumps or
///                 pruning
SimplifiedGroup simplifyGroup(const GroupMesh& group, size_t target_triangles, size_t max_triangles,
                              const std::optional<CostStop>& stop = std::nullopt);

/// Return the costs of the collapses that simplifyGroup does without jumps, until `least` triangles are left
/// or no collapse is valid.
std::vector<CollapseStep> collapseCosts(const GroupMesh& group, size_t least);

} // namespace hearth::clusters
