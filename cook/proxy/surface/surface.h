// Triangulated surface that a proxy is made from.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/mesh/mesh_view.h"
#include "formats/base/math.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hearth::proxy
{

/// Triangles of a mesh. Triangles that meet at a place share its position.
struct Surface
{
    std::vector<Float3> positions;   ///< metres, object space; finite
    std::vector<uint32_t> indices;   ///< three for each triangle
    std::vector<uint32_t> materials; ///< of each triangle, or kInvalidIndex

    size_t triangleCount() const { return materials.size(); }
    std::array<Float3, 3> corners(size_t triangle) const
    {
        return {positions[indices[3 * triangle]], positions[indices[3 * triangle + 1]],
                positions[indices[3 * triangle + 2]]};
    }
    void add(std::array<uint32_t, 3> triangle, uint32_t material)
    {
        indices.insert(indices.end(), triangle.begin(), triangle.end());
        materials.push_back(material);
    }
    mesh::MeshView view() const { return {positions, {}, indices}; }
};

/// Return the half-edge, numbered as the corner where it starts, that starts where the given one ends.
inline uint32_t nextHalfEdge(uint32_t half_edge)
{
    return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1;
}

/// Join vertices at equal positions, and drop triangles without area.
void weldByPosition(Surface& surface);

/// Hashes of positions, triangles and materials.
using SurfaceHash = std::array<uint64_t, 3>;

/// Return a hash that surfaces have in common only if they are equal.
SurfaceHash hashSurface(const Surface& surface);

/// Return the diagonal of the positions' box in metres, 0 without positions.
float findDiagonal(const Surface& surface);

} // namespace hearth::proxy
