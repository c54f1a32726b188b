// Surface point in world space with all values that shading needs, computed from a triangle and barycentric
// weights.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/reference/double3.h"
#include "tests/reference/placement.h"

namespace hearth::reference
{

/// Hit of a ray in the scene.
struct SurfaceHit
{
    uint32_t instance = 0;
    uint32_t cluster = 0;
    uint32_t triangle = 0;
    double weights[3] = {1, 0, 0}; ///< barycentric, one for each corner
    double distance = 0;
    bool front = true;
};

struct SurfacePoint
{
    Double3 position;
    Double3 geometric_normal; ///< unit, of the front side
    Double3 normal;           ///< unit, interpolated, of the front side
    Double3 tangent;          ///< unit; of UV set `tangent_set` where the vertices have none
    Double3 bitangent;        ///< unit; direction of green in a normal map
    Float2 uv[4];
    double uv_per_metre[4] = {}; ///< square root of UV area over world area
    Float4 color{1, 1, 1, 1};
};

SurfacePoint surfaceAt(const Placement& placement, const SurfaceHit& hit, uint32_t tangent_set);

} // namespace hearth::reference
