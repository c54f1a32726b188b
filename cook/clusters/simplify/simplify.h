// Halves the triangles of one group by collapsing edges, without touching what it shares with others.
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

inline constexpr uint32_t kPruned = 0xFFFFFFFFu;

struct Simplified
{
    std::vector<uint32_t> corners;         ///< wedges of the group's mesh, three for each triangle left
    std::vector<uint32_t> materials;       ///< for each triangle left
    std::vector<uint32_t> source_triangle; ///< for each triangle left, the triangle of the group that it was
    std::vector<uint32_t> target_of_position; ///< where each position went: itself, another, or kPruned
    Placement placement;                      ///< where the positions that are left lie now
    bool permissive = false;                  ///< attributes had to jump across a seam
    bool pruned = false;                      ///< whole islands are gone
    bool merged = false;                      ///< positions were merged by cells

    size_t triangleCount() const { return corners.size() / 3; }
};

/// Another place to stop than a count: where collapses begin to cost more than `cost`, at the full clusters below what is
/// left then.
struct CostStop
{
    double cost = 0;  ///< quadric error, object space: area times squared distance
    size_t least = 1; ///< triangles that stay whatever they cost
    size_t most = 1;  ///< and that may stay
};

/// What a collapse cost, or a dearer one before it, and what it left.
struct CollapseStep
{
    double cost; ///< as in CostStop
    size_t triangles;
};

/// Collapse edges, cheapest first by quadric error, until `target_triangles` are left or nothing more can go.
/// What holds after every collapse:
/// - locked positions stay;
/// - every wedge of the removed position goes to a wedge of the target along their common edge, so that attributes and
///   materials do not jump (unless `permissive`: then wedges without such an edge take the nearest attributes). Wedges
///   that differ from one with a way in the normal alone need none: hard edges cost what they change;
/// - open borders, and edges of more than two triangles, only shorten along themselves;
/// - no triangle turns over, no two sheets are glued together (link condition), no island disappears.
/// Positions that others went to are then placed anew, where the quadrics are least, and their attributes with them.
/// If that is not enough, whole islands go, the smallest first (`pruned`); one triangle always stays.
/// most_triangles  with more than these nothing is gained: attributes may jump and islands go before it comes to that
/// stop            where collapses end; `target_triangles` is for groups that nothing but jumps and islands bring so far
Simplified simplifyGroup(const GroupMesh& group, size_t target_triangles, size_t most_triangles,
                         const std::optional<CostStop>& stop = std::nullopt);

/// The collapses that simplifyGroup does without jumps until `least` triangles are left or nothing more can go.
std::vector<CollapseStep> collapseCosts(const GroupMesh& group, size_t least);

} // namespace hearth::clusters
