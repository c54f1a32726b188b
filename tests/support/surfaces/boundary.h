// Boundary loops of triangle surfaces, walked by OpenMesh, and the test that a simplified surface has no
// others: the reference for tests of cracks. Takes nothing from the code under test.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace hearth
{

/// Closed path along edges that have a triangle on one side only.
struct BoundaryLoop
{
    std::vector<uint32_t> positions; ///< position ids in the order of the path
};

/// Edge of two positions.
struct PositionEdge
{
    uint32_t from = 0, to = 0;
};

/// Boundary of a surface. OpenMesh holds 2-manifolds only. So sheets that touch at a position are taken apart
/// there, and triangles at a complex edge (three or more triangles, or two that run the same way) are taken
/// apart along it. Loops along such a cut are not the surface's own and are left out.
struct Boundary
{
    std::vector<BoundaryLoop> loops;
    /// Edges of the loops that are left out, and complex edges, at which the surface ends: an odd number of
    /// triangles, or more that run one way than the other.
    std::vector<PositionEdge> other_open_edges;
    std::vector<PositionEdge> complex_edges;
    /// All positions that triangles use, ascending; empty without complex edges.
    std::vector<uint32_t> positions;
    uint64_t refused_triangles = 0; ///< triangles that OpenMesh refuses all the same: none are expected
};

/// Triangles with two equal positions are left out: they join the triangles beside them.
/// triangles  three position ids for each; positions are welded: one id for each place
Boundary findBoundary(std::span<const uint32_t> triangles);

/// Compare the boundary of a simplified surface with its source's. Empty if each loop of it
/// - passes positions of one loop of the source, in their order, and no other loop passes the same one; or
/// - passes hardly any of the source's boundary: an island that moved, of whose positions at most two or half
///   lie there by chance, as on a chess board. There are at most as many of these as loops of the source that
///   no other loop stands for.
/// So a closed surface stays closed, and so does a closed island of an open surface while all loops of the
/// source are left. Where the boundary touches complex edges, its ends must be on the source's boundary. A
/// source that has complex edges itself promises less: its loops may also join and part along them, and
/// islands that moved are not counted. Otherwise a message.
std::string findCrack(const Boundary& source, const Boundary& simplified);

} // namespace hearth
