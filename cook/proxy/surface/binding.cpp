// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/proxy/surface/binding.h"

#include "cook/clusters/surface/surface_bound.h"
#include "cook/mesh/closest_point.h"
#include "cook/mesh/distinct_triangles.h"
#include "formats/base/rounding.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace hearth::proxy
{

namespace
{

// A point that faces away is taken where one that faces the normal's way is this many times as far.
constexpr double kMuchCloser = 8;

/// Round barycentric weights to sixteen bits, so that they sum to one at most.
std::array<uint16_t, 2> codeWeights(float u, float v)
{
    const auto code = [](float weight)
    { return static_cast<uint32_t>(std::lround(std::clamp(weight, 0.0f, 1.0f) * 65535.0f)); };
    const uint32_t first = code(u);
    return {static_cast<uint16_t>(first), static_cast<uint16_t>(std::min(code(v), 65535 - first))};
}

/// Surface of a proxy or a mesh as the cluster builder sees it, without copies of triangles: each search
/// would visit all of them.
class BoundedSurface
{
public:
    explicit BoundedSurface(const Surface& surface)
        : positions_(surface.positions),
          corners_(clusters::convertIds<clusters::VertexId>(
              mesh::selectTriangles(surface.indices, mesh::findDistinctTriangles(surface.indices))))
    {
    }
    operator clusters::SurfaceView() const { return {positions_, corners_}; }

private:
    clusters::IdVector<clusters::VertexId, Float3> positions_;
    clusters::CornerVector<clusters::VertexId> corners_;
};

} // namespace

std::vector<formats::ProxyBindingRecord> bindVertices(const FinestVertices& vertices, const Surface& proxy)
{
    const mesh::ClosestPoint closest(proxy.view(), proxy.triangleCount());
    std::vector<formats::ProxyBindingRecord> bindings(vertices.positions.size());
    const auto bind = [&](const tbb::blocked_range<size_t>& range)
    {
        uint32_t near = kInvalidIndex;
        for (size_t v = range.begin(); v < range.end(); ++v)
        {
            constexpr double kAnyDistance = std::numeric_limits<double>::infinity();
            const Float3 position = vertices.positions[v];
            mesh::ClosestPoint::Hit found = closest.find(position, {}, kAnyDistance, near);
            if (!vertices.normals.empty())
            {
                const double limit2 = found.distance2 * (kMuchCloser * kMuchCloser);
                const auto facing = closest.find(position, vertices.normals[v], limit2, found.triangle);
                found = facing.triangle != kInvalidIndex ? facing : found;
            }
            near = found.triangle;
            const auto [u, w] = codeWeights(found.u, found.v);
            bindings[v] = {found.triangle, {u, w}, static_cast<float>(std::sqrt(found.distance2))};
        }
    };
    tbb::parallel_for(tbb::blocked_range<size_t>(0, bindings.size(), 1024), bind, tbb::simple_partitioner());
    return bindings;
}

Distances boundDistances(const Surface& mesh, const Surface& proxy, double enough)
{
    const clusters::SurfaceBounds bounds = clusters::boundSurfaceSides(
        BoundedSurface(proxy), BoundedSurface(mesh), enough * double{findDiagonal(mesh)});
    return {roundUp(bounds.a.upper), roundUp(bounds.b.upper)};
}

Distances SharedDistances::bound(const Surface& mesh, const Surface& proxy)
{
    const auto [found, is_new] = distances_.try_emplace(std::array{hashSurface(mesh), hashSurface(proxy)});
    if (is_new)
        found->second = boundDistances(mesh, proxy, enough_);
    return found->second;
}

} // namespace hearth::proxy
