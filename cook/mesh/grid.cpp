// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/mesh/grid.h"

#include "cook/mesh/triangles.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hearth::mesh
{

namespace
{

constexpr int kBits = 16;
constexpr int kMostExtraBits = 4;

/// Largest power of two that is not above x; x positive.
double powerOfTwoBelow(double x)
{
    return std::ldexp(1.0, std::ilogb(x));
}

double largestPart(Float3 from, Float3 to)
{
    return std::max(
        {std::abs(double{to.x} - from.x), std::abs(double{to.y} - from.y), std::abs(double{to.z} - from.z)});
}

/// Least of the edges' largest coordinate differences: a step no larger keeps the ends of every edge apart.
double shortestEdge(const SourceMesh& mesh)
{
    double shortest = std::numeric_limits<double>::infinity();
    for (size_t t = 0; t < mesh.indices.size(); t += 3)
    {
        const Float3 a = mesh.positions[mesh.indices[t]];
        const Float3 b = mesh.positions[mesh.indices[t + 1]];
        const Float3 c = mesh.positions[mesh.indices[t + 2]];
        const double least = std::min({largestPart(a, b), largestPart(b, c), largestPart(c, a)});
        if (least < shortest && !isDegenerate(a, b, c))
            shortest = least;
    }
    return shortest;
}

/// 0 for a mesh without extent: its positions stay as they are.
double gridStep(const SourceMesh& mesh)
{
    Box3 box;
    for (const Float3 p : mesh.positions)
        box.add(p);
    double extent = 0;
    double farthest = 0;
    for (int axis = 0; axis < 3 && !box.empty(); ++axis)
    {
        extent = std::max(extent, double{box.max[axis]} - box.min[axis]);
        farthest = std::max({farthest, std::abs(double{box.min[axis]}), std::abs(double{box.max[axis]})});
    }
    if (!(extent > 0))
        return 0;
    double step = powerOfTwoBelow(std::ldexp(extent, -kBits));
    if (const double shortest = shortestEdge(mesh); shortest < step)
        step = std::max(powerOfTwoBelow(shortest), std::ldexp(step, -kMostExtraBits));
    const double float_step = std::ldexp(powerOfTwoBelow(farthest), 1 - std::numeric_limits<float>::digits);
    return std::max({step, float_step, double{std::numeric_limits<float>::denorm_min()}});
}

} // namespace

float snap(double coordinate, double step)
{
    // + 0.0: the grid has one zero
    return static_cast<float>(std::nearbyint(coordinate / step) * step + 0.0);
}

Grid snapToGrid(SourceMesh& mesh)
{
    Grid grid;
    grid.step = gridStep(mesh);
    if (grid.step == 0)
        return grid;
    double farthest2 = 0;
    for (Float3& p : mesh.positions)
    {
        double distance2 = 0;
        for (int axis = 0; axis < 3; ++axis)
        {
            const float snapped = snap(p[axis], grid.step);
            const double moved = double{snapped} - p[axis];
            distance2 += moved * moved;
            p[axis] = snapped;
        }
        farthest2 = std::max(farthest2, distance2);
    }
    grid.error = std::nextafter(static_cast<float>(std::sqrt(farthest2)), std::numeric_limits<float>::max());
    return grid;
}

} // namespace hearth::mesh
