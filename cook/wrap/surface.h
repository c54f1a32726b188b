// Triangulated surface that is wrapped, or that wraps.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/double3.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hearth::wrap
{

/// Triangles over points that they share.
struct Surface
{
    std::vector<Float3> positions;
    std::vector<uint32_t> indices; ///< three for each triangle

    size_t triangleCount() const { return indices.size() / 3; }
    std::array<Float3, 3> corners(size_t triangle) const
    {
        return {positions[indices[3 * triangle]], positions[indices[3 * triangle + 1]],
                positions[indices[3 * triangle + 2]]};
    }
};

} // namespace hearth::wrap
