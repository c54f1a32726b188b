// Triangle mesh as passed between the stages of the fit, and sample points that represent area on it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/index.h"
#include "formats/base/math.h"

#include <cstdint>
#include <span>

namespace hearth::visibility
{

struct MeshView
{
    std::span<const Float3> positions; ///< finite
    std::span<const Float3> normals;   ///< unit, one for each position
    std::span<const uint32_t> indices; ///< three for each triangle, in range

    size_t triangleCount() const { return indices.size() / 3; }
};

/// Sample point (1 - u - v) corner0 + u corner1 + v corner2 of a triangle.
struct SurfaceSample
{
    uint32_t triangle = kInvalidIndex;
    float u = 0;
    float v = 0;
    float area = 0; ///< represented by the sample, in squared units of the positions; not negative

    float weight = 1; ///< share of the area that counts, positive: small for samples that are never visible

    friend bool operator==(const SurfaceSample&, const SurfaceSample&) = default;
};

} // namespace hearth::visibility
