// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/wrap/decimate.h"

#include "cook/clusters/core/group_mesh.h"
#include "cook/clusters/simplify/simplify.h"
#include "cook/wrap/check.h"
#include "cook/wrap/thread_time.h"
#include "formats/base/index.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace hearth::wrap
{

using namespace clusters;

namespace
{

constexpr double kMinTriangles = 4; // of a closed surface
constexpr double kFiner = 1.15;     // ratio of triangles of tries

/// Return a wrap as one group of the cluster builder: without attributes, and free to move everywhere.
GroupMesh makeGroup(const Surface& wrap)
{
    GroupMesh group;
    for (const Float3 position : wrap.positions)
        group.mesh_box.add(position);
    const Double3 low = widen(group.mesh_box.min), high = widen(group.mesh_box.max);
    const Double3 middle = (low + high) * 0.5, half = (high - low) * 0.5;
    group.center[0] = middle.x;
    group.center[1] = middle.y;
    group.center[2] = middle.z;
    group.scale = std::max({half.x, half.y, half.z});
    group.grid_step = std::ldexp(1, std::ilogb(group.scale) - 22); // about as fine as floats
    for (uint32_t i = 0; i < wrap.positions.size(); ++i)
    {
        group.positions.push_back(narrow((widen(wrap.positions[i]) - middle) * (1 / group.scale)));
        group.locked.push_back(0);
        group.vertex_of_wedge.push_back(VertexId{i});
        group.position_id_of_wedge.push_back(PositionId{i});
        group.chart_of_wedge.push_back(WedgeId{i});
    }
    for (const uint32_t index : wrap.indices)
        group.corners.push_back(WedgeId{index});
    group.materials.resize(wrap.triangleCount(), 0);
    group.errors.resize(wrap.triangleCount(), 0);
    return group;
}

Surface makeDecimated(const GroupMesh& group, const SimplifiedGroup& simplified, const Surface& wrap)
{
    Surface surface;
    std::vector<uint32_t> index_of_position(wrap.positions.size(), kInvalidIndex);
    for (const WedgeId wedge : simplified.corners)
    {
        const PositionId position = group.position_id_of_wedge[wedge];
        uint32_t& index = index_of_position[toIndex(position)];
        if (index == kInvalidIndex)
        {
            index = static_cast<uint32_t>(surface.positions.size());
            surface.positions.push_back(simplified.placement.modified[position] != 0
                                            ? simplified.placement.object_positions[position]
                                            : wrap.positions[toIndex(position)]);
        }
        surface.indices.push_back(index);
    }
    return surface;
}

/// True if no point of a decimated wrap that is looked at is farther from the wrap than `error_m`: corners,
/// and middles of edges and triangles.
bool isClose(const Surface& decimated, const SourceTree& wrap, double error_m)
{
    const auto isCloseAt = [&](Double3 point) { return wrap.isWithin(point, error_m * error_m); };
    for (size_t i = 0; i < decimated.triangleCount(); ++i)
    {
        const std::array<Float3, 3> corners = decimated.corners(i);
        const Double3 a = widen(corners[0]), b = widen(corners[1]), c = widen(corners[2]);
        // the other ends of edges are the first corners of other triangles' edges
        if (!isCloseAt((a + b + c) * (1 / 3.)) || !isCloseAt(a) || !isCloseAt((a + b) * 0.5) ||
            !isCloseAt((b + c) * 0.5) || !isCloseAt((c + a) * 0.5))
            return false;
    }
    return true;
}

/// Move the corners of triangles away from the closest points of the source.
void pushAway(Surface& surface, const SourceTree& source, std::span<const uint32_t> triangles,
              double distance_m)
{
    std::set<uint32_t> corners;
    for (const uint32_t triangle : triangles)
        for (size_t k = 0; k < 3; ++k)
            corners.insert(surface.indices[3 * size_t{triangle} + k]);
    uint32_t hint = 0;
    for (const uint32_t corner : corners)
    {
        Float3& position = surface.positions[corner];
        const SourceTree::Nearest nearest = source.findNearest(widen(position), hint);
        hint = nearest.triangle;
        if (nearest.distance2 > 0)
            position = narrow(widen(position) + nearest.offset * (distance_m / std::sqrt(nearest.distance2)));
    }
}

/// Push triangles that break a promise, mostly by touching the source, away from it, farther each time.
/// returns  whether the surface is without a fault then
bool mend(Surface& surface, const SourceTree& source, double step_m)
{
    constexpr int kMaxSteps = 6;
    for (int step = 0; step < kMaxSteps; ++step, step_m *= 2)
    {
        const Fault fault = findFault(surface, source);
        if (fault.text.empty())
            return true;
        if (fault.triangles.empty())
            return false;
        pushAway(surface, source, fault.triangles, step_m);
    }
    return false;
}

} // namespace

std::optional<Surface> decimateWrap(const Surface& wrap, const SourceTree& source,
                                    const DecimationLimits& limits)
{
    const double end = threadSeconds() + limits.max_seconds;
    const GroupMesh group = makeGroup(wrap);
    const SourceTree tree(wrap, std::numeric_limits<double>::infinity());
    const auto decimate = [&](double triangles)
    {
        return makeDecimated(
            group, simplifyGroup(group, static_cast<size_t>(triangles), wrap.triangleCount()), wrap);
    };
    // the fewest triangles that are close to the wrap, by halving the range in which they are
    const auto wrap_triangles = static_cast<double>(wrap.triangleCount());
    double low = kMinTriangles, close_triangles = wrap_triangles;
    while (close_triangles > kFiner * low)
    {
        if (threadSeconds() >= end)
            return std::nullopt;
        const double middle = std::sqrt(low * close_triangles);
        (isClose(decimate(middle), tree, limits.error_m) ? close_triangles : low) = middle;
    }
    double triangles = std::min(close_triangles, static_cast<double>(limits.triangles));
    for (; triangles * kFiner < wrap_triangles; triangles *= kFiner)
    {
        if (threadSeconds() >= end)
            return std::nullopt;
        Surface surface = decimate(triangles);
        if (mend(surface, source, limits.step_m) &&
            (triangles < close_triangles || isClose(surface, tree, limits.error_m)))
            return surface;
    }
    return wrap;
}

} // namespace hearth::wrap
