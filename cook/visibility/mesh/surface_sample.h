// Sample points that represent area on a mesh, and the mesh as the stages of the fit pass it on.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/mesh/mesh_view.h"
#include "formats/base/index.h"

#include <cstdint>

namespace hearth::visibility
{

using mesh::MeshView;

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
