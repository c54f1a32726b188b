// Triangles as the stages of the fit hand them to each other, and points on them that stand for area.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

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

/// The point (1 - u - v) corner0 + u corner1 + v corner2 of a triangle.
struct SurfaceSample
{
    uint32_t triangle = kNowhere;
    float u = 0;
    float v = 0;
    float area = 0; ///< that the sample stands for, in the squared units of the positions; not negative

    float weight = 1; ///< how much of its area counts, positive: less for what nobody looks at

    friend bool operator==(const SurfaceSample&, const SurfaceSample&) = default;
};

} // namespace hearth::visibility
