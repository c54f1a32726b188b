// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/bench/cut_quality.h"

#include "formats/pack_view.h"
#include "tests/cook/cuts.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

namespace hearth::bench
{

namespace
{

double angleInDegrees(Float3 a, Float3 b)
{
    return std::atan2(double{length(cross(a, b))}, double{dot(a, b)}) * 180 / std::numbers::pi;
}

struct Sums
{
    double distance2 = 0;
    double angle2 = 0;
    double max = 0;

    Sums operator+(const Sums& b) const
    {
        return {distance2 + b.distance2, angle2 + b.angle2, std::max(max, b.max)};
    }
};

/// Sums over [0, count); the same for any number of threads.
template <typename AddOne>
Sums sumOver(size_t count, const AddOne& add_one)
{
    return tbb::parallel_deterministic_reduce(
        tbb::blocked_range<size_t>(0, count, 1024), Sums{},
        [&](const tbb::blocked_range<size_t>& range, Sums sums)
        {
            for (size_t i = range.begin(); i < range.end(); ++i)
                add_one(i, sums);
            return sums;
        },
        [](const Sums& a, const Sums& b) { return a + b; });
}

/// Distances of points on `from` to the surface `to`, and of their normals.
Sums oneWay(const CutSurface& from, std::span<const SurfacePoint> points, const CutSurface& to,
            const SurfaceDistance& distance)
{
    const bool has_normals = !from.normals.empty() && !to.normals.empty();
    Sums sums =
        sumOver(points.size(),
                [&](size_t i, Sums& s)
                {
                    const auto nearest = distance.nearest(valueAt(points[i], from.positions, from.triangles));
                    s.distance2 += nearest.distance * nearest.distance;
                    s.max = std::max(s.max, nearest.distance);
                    if (!has_normals)
                        return;
                    const double angle = angleInDegrees(valueAt(points[i], from.normals, from.triangles),
                                                        valueAt(nearest.point, to.normals, to.triangles));
                    s.angle2 += angle * angle;
                });
    sums.max = std::max(sums.max, sumOver(from.positions.size(), [&](size_t i, Sums& s)
                                          { s.max = std::max(s.max, distance.to(from.positions[i])); })
                                      .max);
    return sums;
}

} // namespace

CutSurface surfaceOfMesh(const mesh::SourceMesh& mesh)
{
    return {mesh.positions, mesh.normals, mesh.indices, 0};
}

CutSurface surfaceOfCut(const clusters::Hierarchy& hierarchy, const clusters::DecodedHierarchy& decoded,
                        double error)
{
    CutSurface surface;
    for (const uint32_t c : clusters::clustersOfCut(hierarchy, cuts::cutAtError(hierarchy, error)))
    {
        const formats::ClusterRecord& cluster = hierarchy.clusters[c];
        const auto geometry =
            formats::ClusterGeometry::at(decoded.pages[cluster.page], cluster, hierarchy.mesh);
        HEARTH_ASSERT(geometry.has_value());
        const auto first = static_cast<uint32_t>(surface.positions.size());
        for (uint32_t v = 0; v < geometry->vertexCount(); ++v)
        {
            surface.positions.push_back(geometry->position(v));
            if (geometry->has(formats::kVertexNormal))
                surface.normals.push_back(geometry->normal(v));
        }
        for (uint32_t t = 0; t < geometry->triangleCount(); ++t)
            for (const uint32_t corner : geometry->triangle(t))
                surface.triangles.push_back(first + corner);
        surface.stored_error =
            std::max(surface.stored_error, double{formats::errorOf(cluster, hierarchy.groups)});
    }
    return surface;
}

CutMeter::CutMeter(const CutSurface& source, size_t samples)
    : source_(source),
      samples_(samples),
      to_source_(source.positions, source.triangles),
      on_source_(evenlySpread(source.positions, source.triangles, samples))
{
}

CutQuality CutMeter::measure(const CutSurface& cut) const
{
    const SurfaceDistance to_cut(cut.positions, cut.triangles);
    const auto on_cut = evenlySpread(cut.positions, cut.triangles, samples_);
    const Sums out = oneWay(cut, on_cut, source_, to_source_);
    const Sums back = oneWay(source_, on_source_, cut, to_cut);
    CutQuality quality;
    quality.triangles = cut.triangleCount();
    quality.rms =
        std::sqrt((out.distance2 + back.distance2) / static_cast<double>(on_cut.size() + on_source_.size()));
    quality.max = std::max(out.max, back.max);
    quality.normal_rms_deg = std::sqrt(out.angle2 / static_cast<double>(std::max<size_t>(on_cut.size(), 1)));
    quality.stored_error = cut.stored_error;
    return quality;
}

} // namespace hearth::bench
