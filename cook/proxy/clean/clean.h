// Cleans a surface: any triangles become a manifold without needles, whose shells face outwards.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/mesh/thin_triangles.h"
#include "cook/proxy/clean/holes.h"
#include "cook/proxy/clean/orientation.h"
#include "cook/proxy/surface/half_edges.h"
#include "cook/proxy/surface/surface.h"

namespace hearth::proxy
{

struct CleanSettings
{
    /// Maximum length of a hole's boundary that is filled, over the diagonal of the surface's box.
    double hole_length = 0.05;
    /// Minimum height of a triangle over its longest edge.
    double thinness = 1e-3;
};

struct CleanStatistics
{
    mesh::ThinTriangleStatistics thin;
    OrientationStatistics orientation;
    ManifoldStatistics manifold;
    HoleStatistics holes;
};

/// Clean a surface: remove thin and doubled triangles, turn triangles and shells, take apart what is no
/// manifold, fill small holes. Afterwards each edge has one triangle, or two that pass it in opposite
/// directions, each vertex one fan of triangles, and each position a triangle. Deterministic on
/// processors of one class. Time O(n log n).
CleanStatistics cleanSurface(Surface& surface, const CleanSettings& settings = {});

} // namespace hearth::proxy
