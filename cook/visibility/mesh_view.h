// Triangles as the stages of the fit hand them to each other, and points on them that stand for area.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/surface_samples.h"
#include "formats/math.h"

#include <cstdint>
#include <span>

namespace hearth::visibility
{

/// No triangle, no vertex.
inline constexpr uint32_t kNowhere = 0xFFFFFFFFu;

struct MeshView
{
    std::span<const Float3> positions; ///< finite
    std::span<const Float3> normals;   ///< unit, one for each position
    std::span<const uint32_t> indices; ///< three for each triangle, in range

    size_t triangleCount() const { return indices.size() / 3; }
};

using SampleRef = SurfaceSample;

} // namespace hearth::visibility
