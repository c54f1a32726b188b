// Triangles of a mesh with their neighbours.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/double3.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace hearth::receivers
{

struct TriangleGraph
{
    /// List the neighbours of triangles across edges. Vertices at one position count as one. An edge with
    /// more or fewer than two triangles, or with two that face opposite ways, has no neighbours.
    /// positions  finite
    /// indices    three for each triangle
    TriangleGraph(std::span<const Float3> positions, std::span<const uint32_t> indices);

    size_t triangleCount() const { return areas.size(); }

    /// Neighbours across the edges from corner i to corner i + 1, or kInvalidIndex.
    std::vector<std::array<uint32_t, 3>> neighbours;
    std::vector<Double3> normals; ///< unit; 0 of a triangle without area
    std::vector<double> areas;    ///< square metres
};

} // namespace hearth::receivers
