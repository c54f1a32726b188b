// Triangle mesh that others own, as spans.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

#include <algorithm>
#include <cstdint>
#include <span>

namespace hearth::mesh
{

struct MeshView
{
    std::span<const Float3> positions; ///< finite
    std::span<const Float3> normals;   ///< unit, one for each position
    std::span<const uint32_t> indices; ///< three for each triangle, in range

    size_t triangleCount() const { return indices.size() / 3; }
};

inline double longestEdge(const MeshView& mesh, size_t triangle)
{
    double longest = 0;
    for (size_t k = 0; k < 3; ++k)
    {
        const Float3 a = mesh.positions[mesh.indices[triangle * 3 + k]];
        const Float3 b = mesh.positions[mesh.indices[triangle * 3 + (k + 1) % 3]];
        longest = std::max(longest, double{length(b - a)});
    }
    return longest;
}

} // namespace hearth::mesh
