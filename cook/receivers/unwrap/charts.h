// Divides a mesh into charts: connected pieces that are flat enough to be projected on a plane.
// Source: the growth of charts around seeds is that of B. Levy et al., "Least squares conformal maps for
// automatic texture atlas generation", SIGGRAPH 2002, section 3, with planes in place of features.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/receivers/unwrap/triangle_graph.h"

#include <vector>

namespace hearth::receivers
{

/// Triangles of a chart, rising.
using Chart = std::vector<uint32_t>;

/// Divide all triangles with an area into charts. A chart's triangles are connected across edges, and face
/// the chart's mean normal within about 70 degrees. Charts with less area than a texel may be exceptions: a
/// chart beside takes them, so that a rough surface does not fall apart.
/// texel_area  square metres
std::vector<Chart> growCharts(const TriangleGraph& graph, double texel_area);

/// Return the unit mean normal of triangles, weighted by area. (0, 0, 1) where they cancel.
Double3 meanNormal(const TriangleGraph& graph, const Chart& chart);

/// Divide a chart of two triangles or more between its two ends.
/// returns  two charts, each of connected triangles where `chart` is
std::vector<Chart> splitChart(const TriangleGraph& graph, const Chart& chart);

} // namespace hearth::receivers
