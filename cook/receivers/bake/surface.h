// Triangles of a scene whose baked light is computed, and points on them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

#include <array>
#include <cstdint>
#include <span>

namespace hearth::receivers
{

/// Triangle in world space, metres. Its corners run counterclockwise as seen from its front.
struct Triangle
{
    std::array<Float3, 3> corners; ///< finite
    std::array<Float3, 3> normals; ///< of the smooth surface, unit, on the side of the front
    std::array<Float2, 3> uvs;     ///< of the receivers' UV set
    Float3 albedo;                 ///< 0 to 1, linear Rec.709
    uint32_t instance = 0;
    bool double_sided = false; ///< the back is a surface, too; otherwise it is black
};

/// Point of a triangle.
struct SurfacePoint
{
    uint32_t triangle = 0; ///< index in a list of triangles
    Float2 weights;        ///< of corners 1 and 2
};

/// Interpolate between the values of a triangle's corners.
template <typename Value>
Value interpolate(const std::array<Value, 3>& values, Float2 weights)
{
    return values[0] * (1 - weights.x - weights.y) + values[1] * weights.x + values[2] * weights.y;
}

/// Return the vector along a triangle's normal whose length is twice the area.
inline Float3 crossEdges(const Triangle& triangle)
{
    return cross(triangle.corners[1] - triangle.corners[0], triangle.corners[2] - triangle.corners[0]);
}

} // namespace hearth::receivers
