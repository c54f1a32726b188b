// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/mesh/grid.h"

#include "cook/mesh/triangles.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

namespace hearth::mesh
{

namespace
{

using Block = tbb::blocked_range<size_t>;
constexpr size_t kGrain = 16384;

constexpr int kBits = 16;
/// Deformed meshes get a finer grid: their poses are compared with those of other programs to 1e-5 of the
/// model's size.
constexpr int kDeformedBits = 18;
constexpr int kMaxExtraBits = 4;

/// Return the largest power of two that is not above x; x positive.
double powerOfTwoBelow(double x)
{
    return std::ldexp(1.0, std::ilogb(x));
}

double maxDifference(Float3 from, Float3 to)
{
    return std::max(
        {std::abs(double{to.x} - from.x), std::abs(double{to.y} - from.y), std::abs(double{to.z} - from.z)});
}

/// Return the minimum, over the edges, of the largest coordinate difference: a step no larger keeps the ends
/// of every edge apart.
double shortestEdge(const SourceMesh& mesh)
{
    const auto shortestInBlock = [&](const Block& triangles, double shortest)
    {
        for (size_t t = triangles.begin(); t < triangles.end(); ++t)
        {
            const Float3 a = mesh.positions[mesh.indices[t * 3]];
            const Float3 b = mesh.positions[mesh.indices[t * 3 + 1]];
            const Float3 c = mesh.positions[mesh.indices[t * 3 + 2]];
            const double least = std::min({maxDifference(a, b), maxDifference(b, c), maxDifference(c, a)});
            if (least < shortest && !isDegenerate(a, b, c))
                shortest = least;
        }
        return shortest;
    };
    return tbb::parallel_reduce(Block(0, mesh.triangleCount(), kGrain),
                                std::numeric_limits<double>::infinity(), shortestInBlock,
                                [](double a, double b) { return std::min(a, b); });
}

/// Compute the grid step; 0 for a mesh without extent, whose positions stay unchanged.
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
    const bool deforms = !mesh.joint_sets.empty() || !mesh.morph_targets.empty();
    double step = powerOfTwoBelow(std::ldexp(extent, -(deforms ? kDeformedBits : kBits)));
    if (const double shortest = shortestEdge(mesh); shortest < step)
        step = std::max(powerOfTwoBelow(shortest), std::ldexp(step, -kMaxExtraBits));
    const double float_step = std::ldexp(powerOfTwoBelow(farthest), 1 - std::numeric_limits<float>::digits);
    return std::max({step, float_step, double{std::numeric_limits<float>::denorm_min()}});
}

} // namespace

float snap(double coordinate, double step)
{
    // + 0.0: the grid has no negative zero
    return static_cast<float>(std::nearbyint(coordinate / step) * step + 0.0);
}

namespace
{

/// Snap a position. Returns the squared distance that it moves.
double snapPosition(Float3& position, double step)
{
    double distance2 = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
        const float snapped = snap(position[axis], step);
        const double moved = double{snapped} - position[axis];
        distance2 += moved * moved;
        position[axis] = snapped;
    }
    return distance2;
}

} // namespace

Grid snapToGrid(SourceMesh& mesh)
{
    Grid grid;
    grid.step = gridStep(mesh);
    if (grid.step == 0)
        return grid;
    const auto snapAll = [&](const Block& vertices, double farthest2)
    {
        for (size_t v = vertices.begin(); v < vertices.end(); ++v)
            farthest2 = std::max(farthest2, snapPosition(mesh.positions[v], grid.step));
        return farthest2;
    };
    const double farthest2 = tbb::parallel_reduce(Block(0, mesh.vertexCount(), kGrain), 0.0, snapAll,
                                                  [](double a, double b) { return std::max(a, b); });
    grid.error = std::nextafter(static_cast<float>(std::sqrt(farthest2)), std::numeric_limits<float>::max());
    return grid;
}

} // namespace hearth::mesh
