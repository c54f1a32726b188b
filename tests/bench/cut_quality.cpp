// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/bench/cut_quality.h"

#include "formats/pack/pack_view.h"
#include "tests/support/cuts.h"

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
    double uv2 = 0; ///< units of UV
    double max = 0;

    Sums operator+(const Sums& b) const
    {
        return {distance2 + b.distance2, angle2 + b.angle2, uv2 + b.uv2, std::max(max, b.max)};
    }
};

/// Sums over [0, count). The result does not depend on the number of threads.
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

double computeArea(const CutSurface& surface, std::span<const Float3> places, size_t first_triangle)
{
    double area = 0;
    for (size_t i = first_triangle * 3; i < surface.triangles.size(); i += 3)
    {
        const Float3 a = places[surface.triangles[i]];
        area +=
            0.5 *
            double{length(cross(places[surface.triangles[i + 1]] - a, places[surface.triangles[i + 2]] - a))};
    }
    return area;
}

/// Distances of points on `from` to the surface `to`, and of their normals.
Sums oneWay(const CutSurface& from, std::span<const SurfacePoint> points, const CutSurface& to,
            const SurfaceDistance& distance)
{
    const bool has_normals = !from.normals.empty() && !to.normals.empty();
    const bool has_uvs = !from.uvs.empty() && !to.uvs.empty();
    Sums sums =
        sumOver(points.size(),
                [&](size_t i, Sums& s)
                {
                    const auto nearest = distance.nearest(valueAt(points[i], from.positions, from.triangles));
                    s.distance2 += nearest.distance * nearest.distance;
                    s.max = std::max(s.max, nearest.distance);
                    if (has_uvs)
                    {
                        const Float3 away = valueAt(points[i], from.uvs, from.triangles) -
                                            valueAt(nearest.point, to.uvs, to.triangles);
                        s.uv2 += double{dot(away, away)};
                    }
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
    CutSurface surface;
    surface.positions = mesh.positions;
    surface.normals = mesh.normals;
    for (const Float2 uv : mesh.uvs[0])
        surface.uvs.push_back({uv.x, uv.y, 0});
    surface.triangles = mesh.indices;
    return surface;
}

CutSurface surfaceOfCut(const clusters::Hierarchy& hierarchy, const clusters::DecodedHierarchy& decoded,
                        double error)
{
    CutSurface surface;
    double area = 0, normal2 = 0, uv2 = 0;
    for (const uint32_t c : clusters::findCutClusters(hierarchy, cuts::cutAtError(hierarchy, error)))
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
            if (geometry->has(formats::kVertexUv0))
                surface.uvs.push_back({geometry->uv(v, 0).x, geometry->uv(v, 0).y, 0});
        }
        const size_t first_triangle = surface.triangleCount();
        for (uint32_t t = 0; t < geometry->triangleCount(); ++t)
            for (const uint32_t corner : geometry->triangle(t))
                surface.triangles.push_back(first + corner);
        surface.stored_error =
            std::max(surface.stored_error, double{formats::clusterError(cluster, hierarchy.groups)});
        const double own = computeArea(surface, surface.positions, first_triangle);
        area += own;
        if (cluster.refined_group == kInvalidIndex)
            continue;
        const formats::GroupRecord& group = hierarchy.groups[cluster.refined_group];
        normal2 += own * double{group.normal_error} * double{group.normal_error};
        uv2 += own * double{group.uv_error} * double{group.uv_error};
    }
    surface.stored_normal_rms = std::sqrt(normal2 / area);
    surface.stored_uv_rms = std::sqrt(uv2 / area);
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
    const double texture = source_.uvs.empty() ? 0 : computeArea(source_, source_.uvs, 0);
    const double length_of_uv =
        texture > 0 ? std::sqrt(computeArea(source_, source_.positions, 0) / texture) : 0;
    quality.uv_rms =
        length_of_uv * std::sqrt(out.uv2 / static_cast<double>(std::max<size_t>(on_cut.size(), 1)));
    quality.stored_error = cut.stored_error;
    quality.stored_normal_rms_deg = cut.stored_normal_rms * 180 / std::numbers::pi;
    quality.stored_uv_rms = cut.stored_uv_rms;
    return quality;
}

} // namespace hearth::bench
