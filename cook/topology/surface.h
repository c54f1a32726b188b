// Triangles by position: what all findings of a mesh's topology are judged of.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/mesh/source_mesh.h"

#include <cstdint>
#include <vector>

namespace hearth::topology
{

/// Triangle that has the same three corners as an earlier one. Both are triangles of the source.
struct DoubledTriangle
{
    uint32_t first = 0;
    uint32_t copy = 0;
    bool is_opposite = false; ///< the copy faces the other way

    friend bool operator==(const DoubledTriangle&, const DoubledTriangle&) = default;
};

/// Triangles whose corners are position ids: vertices at equal positions are one, since normals and UVs
/// split vertices. Triangles without area are left out, as cooks leave them out, and so are copies of
/// doubled ones. A half-edge has the number of the corner that it starts at: half-edge 3t + k runs from
/// corner k of triangle t to the next one.
struct Surface
{
    std::vector<Float3> positions; ///< by position id; some may have no triangle
    std::vector<uint32_t> corners; ///< position ids, three for each triangle
    std::vector<uint32_t> source_of_triangle;
    std::vector<uint32_t> zero_area;      ///< triangles of the source, ascending
    std::vector<DoubledTriangle> doubled; ///< in the order of the copies

    uint32_t triangleCount() const { return static_cast<uint32_t>(source_of_triangle.size()); }
};

inline uint32_t nextHalfEdge(uint32_t half_edge)
{
    return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1;
}
inline uint32_t previousHalfEdge(uint32_t half_edge)
{
    return half_edge % 3 == 0 ? half_edge + 2 : half_edge - 1;
}

/// Weld the mesh by position and sort out its triangles. Time O(n log n).
Surface makeSurface(const mesh::SourceMesh& mesh);

} // namespace hearth::topology
