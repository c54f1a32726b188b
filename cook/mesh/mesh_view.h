// Triangle mesh that others own, as spans.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

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

} // namespace hearth::mesh
