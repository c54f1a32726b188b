// Projects a chart on a plane.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/receivers/unwrap/charts.h"

#include <array>
#include <span>

namespace hearth::receivers
{

struct Point2
{
    double x = 0, y = 0;
};

/// Chart in the plane across its mean normal, metres. It lies in the box from (0, 0) to (width, height), with
/// the least area of all directions and width >= height.
struct ProjectedChart
{
    Chart triangles;
    std::vector<std::array<Point2, 3>> corners; ///< of each triangle; counterclockwise if it faces the plane
    double width = 0, height = 0;
};

ProjectedChart projectChart(std::span<const Float3> positions, std::span<const uint32_t> indices,
                            const TriangleGraph& graph, Chart chart);

/// Return the share of a grid's points in the chart that lie in more than one triangle.
/// step  metres from point to point, above 0; more where the grid would have 4096 points along a side
double measureOverlap(const ProjectedChart& chart, double step);

} // namespace hearth::receivers
