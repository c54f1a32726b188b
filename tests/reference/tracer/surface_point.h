// A point of a surface in the world, with everything that shading asks: found again from a triangle and weights.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/reference/double3.h"
#include "tests/reference/placement.h"

namespace hearth::reference
{

/// Where a ray meets the scene.
struct SurfaceHit
{
    uint32_t instance = 0;
    uint32_t cluster = 0;
    uint32_t triangle = 0;
    double weights[3] = {1, 0, 0}; ///< of the three corners
    double distance = 0;
    bool front = true;
};

struct SurfacePoint
{
    Double3 position;
    Double3 geometric_normal; ///< unit, of the front side
    Double3 normal;           ///< unit, interpolated, of the front side
    Double3 tangent;          ///< unit; of UV set `tangent_set` where the vertices have none
    Double3 bitangent;        ///< unit, the way a normal map's green points
    Float2 uv[4];
    double uv_per_metre[4] = {}; ///< square root of UV area over world area
    Float4 color{1, 1, 1, 1};
};

SurfacePoint surfaceAt(const Placement& placement, const SurfaceHit& hit, uint32_t tangent_set);

} // namespace hearth::reference
