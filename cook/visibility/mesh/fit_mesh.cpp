// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/mesh/fit_mesh.h"

#include "cook/mesh/closest_point.h"
#include "cook/visibility/mesh/moment_clamp.h"
#include "cook/visibility/mesh/vertex_weld.h"
#include "formats/base/assert.h"

#include <algorithm>
#include <limits>
#include <optional>

#include <tbb/parallel_for.h>

namespace hearth::visibility
{

namespace
{

// Maximum distance of a vertex from the rest of the surface at which it is bound to a point there, in units
// of thinness times the longest edge of its triangles. A corner of a dropped sliver lies within one unit of
// the other two corners.
constexpr double kMaxBindDistance = 10;

// Samples that are looked up in sequence; each search starts at the triangle that the previous one found.
constexpr size_t kSamplesPerTask = 256;

constexpr double kAnyDistance = std::numeric_limits<double>::infinity();

double positionScale(std::span<const Float3> positions)
{
    Box3 box;
    for (const Float3 p : positions)
        box.add(p);
    double size = 0;
    for (int axis = 0; axis < 3 && !box.empty(); ++axis)
        size = std::max({size, double{box.max[axis]} - box.min[axis], std::abs(double{box.min[axis]}),
                         std::abs(double{box.max[axis]})});
    return size;
}

/// Source with welded vertices: the same arrays, but indices refer only to the first of equal vertices.
struct WeldedSource
{
    std::vector<uint32_t> first; ///< first equal vertex, for each vertex
    std::vector<uint32_t> indices;
};

WeldedSource weld(const MeshView& source, const FitMeshSettings& settings)
{
    WeldedSource welded;
    welded.first = findMergedVertices(source, settings);
    welded.indices.reserve(source.indices.size());
    for (const uint32_t vertex : source.indices)
        welded.indices.push_back(welded.first[vertex]);
    return welded;
}

bool hasArea(const MeshView& mesh, size_t triangle)
{
    const Float3* p = mesh.positions.data();
    const uint32_t* corner = mesh.indices.data() + triangle * 3;
    return length(cross(widen(p[corner[1]]) - widen(p[corner[0]]),
                        widen(p[corner[2]]) - widen(p[corner[0]]))) > 0;
}

/// Builds a fit mesh from cleaned triangles. Vertex indices are the source's until compact().
class FitMeshBuilder
{
public:
    FitMeshBuilder(const MeshView& source, const WeldedSource& welded, mesh::CleanTriangles clean,
                   double thinness)
        : source_(source),
          welded_(welded),
          clean_(std::move(clean)),
          thinness_(thinness),
          used_(source.positions.size(), false),
          bindings_(source.positions.size())
    {
        fit_mesh_.smooth_count = clean_.indices.size() / 3;
        fit_mesh_.thinness = thinness;
        fit_mesh_.statistics.thin = clean_.statistics;
        for (const uint32_t vertex : clean_.indices)
            used_[vertex] = true;
    }

    FitMesh build()
    {
        const std::vector<double> reach = longestRemovedEdges();
        bindNearby(reach);
        keepLooseTriangles();
        bindRemaining();
        compact();
        return std::move(fit_mesh_);
    }

private:
    /// Return the vertex that a source vertex is merged into, in the numbering of the source.
    uint32_t mergedVertex(uint32_t vertex) const { return clean_.collapse_target[welded_.first[vertex]]; }

    /// Compute for each vertex the longest edge of its removed triangles, apart from those without area.
    std::vector<double> longestRemovedEdges() const
    {
        std::vector<double> reach(source_.positions.size(), 0);
        for (size_t t = 0; t < source_.triangleCount(); ++t)
        {
            if (clean_.remaining_of_source[t] != kInvalidIndex || !hasArea(source_, t))
                continue;
            const double longest = mesh::longestEdge(source_, t);
            for (size_t k = 0; k < 3; ++k)
            {
                double& vertex_reach = reach[mergedVertex(source_.indices[t * 3 + k])];
                vertex_reach = std::max(vertex_reach, longest);
            }
        }
        return reach;
    }

    /// Bind vertices without a remaining triangle to points of remaining triangles, if these are near.
    void bindNearby(const std::vector<double>& reach)
    {
        const MeshView smooth{source_.positions, source_.normals, clean_.indices};
        std::optional<mesh::ClosestPoint> surface;
        for (uint32_t v = 0; v < used_.size(); ++v)
        {
            if (!(reach[v] > 0) || used_[v])
                continue;
            if (!surface)
                surface.emplace(smooth, fit_mesh_.smooth_count);
            bind(v, *surface, reach[v] * thinness_ * kMaxBindDistance, smooth);
        }
    }

    /// Bind vertices that belong to no triangle with area to the nearest point, at any distance.
    void bindRemaining()
    {
        const MeshView all{source_.positions, source_.normals, clean_.indices};
        std::optional<mesh::ClosestPoint> surface;
        for (uint32_t v = 0; v < used_.size(); ++v)
        {
            if (used_[v] || mergedVertex(v) != v || bindings_[v].vertices[0] != kInvalidIndex)
                continue;
            if (!surface)
                surface.emplace(all, clean_.indices.size() / 3);
            bind(v, *surface, kAnyDistance, all);
        }
    }

    void bind(uint32_t vertex, const mesh::ClosestPoint& surface, double limit, const MeshView& mesh)
    {
        const Float3 p = source_.positions[vertex];
        mesh::ClosestPoint::Hit found =
            surface.find(p, source_.normals[vertex], limit * limit, kInvalidIndex);
        if (found.triangle == kInvalidIndex && limit == kAnyDistance)
            found = surface.find(p, {}, kAnyDistance, kInvalidIndex);
        if (found.triangle == kInvalidIndex)
            return;
        const uint32_t* corners = mesh.indices.data() + size_t{found.triangle} * 3;
        bindings_[vertex] = {{corners[0], corners[1], corners[2]},
                             {(1 - found.u) - found.v, found.u, found.v}};
    }

    /// Keep removed triangles that have a vertex which is neither on another triangle nor bound to one.
    void keepLooseTriangles()
    {
        fit_mesh_.triangle_of_source = clean_.remaining_of_source;
        std::vector<bool> named = used_;
        for (size_t t = 0; t < source_.triangleCount(); ++t)
        {
            if (clean_.remaining_of_source[t] != kInvalidIndex || !hasArea(source_, t))
                continue;
            std::array<uint32_t, 3> corners;
            bool loose = false;
            for (size_t k = 0; k < 3; ++k)
            {
                corners[k] = mergedVertex(source_.indices[t * 3 + k]);
                loose |= !used_[corners[k]] && bindings_[corners[k]].vertices[0] == kInvalidIndex;
            }
            if (!loose)
                continue;
            fit_mesh_.triangle_of_source[t] = static_cast<uint32_t>(clean_.indices.size() / 3);
            ++fit_mesh_.statistics.loose;
            for (const uint32_t corner : corners)
            {
                named[corner] = true;
                bindings_[corner] = {};
                clean_.indices.push_back(corner);
            }
        }
        used_ = std::move(named);
    }

    void compact()
    {
        std::vector<uint32_t> number(used_.size(), kInvalidIndex);
        for (uint32_t v = 0; v < used_.size(); ++v)
            if (used_[v])
            {
                number[v] = static_cast<uint32_t>(fit_mesh_.positions.size());
                fit_mesh_.positions.push_back(source_.positions[v]);
                fit_mesh_.normals.push_back(source_.normals[v]);
            }
        for (const uint32_t vertex : clean_.indices)
            fit_mesh_.indices.push_back(number[vertex]);
        const std::span<const uint32_t> smooth(fit_mesh_.indices.data(), fit_mesh_.smooth_count * 3);
        fit_mesh_.edges = mesh::findInteriorEdges(smooth, fit_mesh_.positions.size());
        fit_mesh_.bindings.resize(used_.size());
        fit_mesh_.statistics.source_vertices = static_cast<uint32_t>(used_.size());
        for (uint32_t v = 0; v < used_.size(); ++v)
        {
            const uint32_t merged = mergedVertex(v);
            fit_mesh_.statistics.welded += welded_.first[v] != v;
            Binding& binding = fit_mesh_.bindings[v];
            if (used_[merged])
                binding.vertices.fill(number[merged]);
            else if (bindings_[merged].vertices[0] != kInvalidIndex)
            {
                for (size_t k = 0; k < 3; ++k)
                    binding.vertices[k] = number[bindings_[merged].vertices[k]];
                binding.weights = bindings_[merged].weights;
                ++fit_mesh_.statistics.nearest;
            }
        }
    }

    const MeshView& source_;
    const WeldedSource& welded_;
    mesh::CleanTriangles clean_;
    double thinness_;
    std::vector<bool> used_; ///< by a triangle of the fit mesh
    std::vector<Binding> bindings_;
    FitMesh fit_mesh_;
};

} // namespace

std::vector<uint32_t> findMergedVertices(const MeshView& source, const FitMeshSettings& settings)
{
    const double tolerance = positionScale(source.positions) * settings.position_tolerance;
    return weldVertices(source.positions, source.normals, tolerance, settings.normal_tolerance);
}

FitMesh makeFitMesh(const MeshView& source, const FitMeshSettings& settings)
{
    HEARTH_ASSERT(source.normals.size() == source.positions.size());
    const WeldedSource welded = weld(source, settings);
    mesh::CleanTriangles clean =
        mesh::removeThinTriangles(source.positions, welded.indices, settings.thinness);
    return FitMeshBuilder(source, welded, std::move(clean), settings.thinness).build();
}

namespace
{

/// Return a sample of a fit mesh triangle that has the corners `original_corners`, perhaps in another order.
SurfaceSample withReorderedCorners(const SurfaceSample& sample,
                                   const std::array<uint32_t, 3>& original_corners, uint32_t triangle,
                                   const uint32_t* corners)
{
    SurfaceSample result = sample;
    result.triangle = triangle;
    if (original_corners[0] == corners[0] && original_corners[1] == corners[1] &&
        original_corners[2] == corners[2])
        return result;
    std::array<float, 3> weights{};
    const std::array<float, 3> original_weights{(1 - sample.u) - sample.v, sample.u, sample.v};
    for (size_t k = 0; k < 3; ++k)
        for (size_t j = 0; j < 3; ++j)
            if (corners[k] == original_corners[j])
                weights[k] = original_weights[j];
    result.u = weights[1];
    result.v = weights[2];
    return result;
}

} // namespace

std::vector<SurfaceSample> mapSamplesToFitMesh(const FitMesh& fit_mesh, const MeshView& source,
                                               std::span<const SurfaceSample> samples)
{
    const auto isRemoved = [&](const SurfaceSample& sample)
    { return fit_mesh.triangle_of_source[sample.triangle] == kInvalidIndex; };
    std::optional<mesh::ClosestPoint> surface;
    if (std::any_of(samples.begin(), samples.end(), isRemoved))
        surface.emplace(fit_mesh.view(), fit_mesh.smooth_count);
    std::vector<SurfaceSample> result(samples.size());
    const auto mapSample = [&](const SurfaceSample& sample, uint32_t hint)
    {
        const uint32_t* corners = source.indices.data() + size_t{sample.triangle} * 3;
        if (const uint32_t triangle = fit_mesh.triangle_of_source[sample.triangle]; triangle != kInvalidIndex)
        {
            std::array<uint32_t, 3> original_corners;
            for (size_t k = 0; k < 3; ++k)
                original_corners[k] = fit_mesh.bindings[corners[k]].vertices[0];
            return withReorderedCorners(sample, original_corners, triangle,
                                        fit_mesh.indices.data() + size_t{triangle} * 3);
        }
        const Float3 a = source.positions[corners[0]];
        const Float3 ab = source.positions[corners[1]] - a, ac = source.positions[corners[2]] - a;
        const double reach =
            mesh::longestEdge(source, sample.triangle) * fit_mesh.thinness * kMaxBindDistance;
        const mesh::ClosestPoint::Hit found =
            surface->find(a + ab * sample.u + ac * sample.v, cross(ab, ac), reach * reach, hint);
        return SurfaceSample{found.triangle, found.u, found.v, sample.area, sample.weight};
    };
    tbb::parallel_for(size_t{0}, (samples.size() + kSamplesPerTask - 1) / kSamplesPerTask,
                      [&](size_t block)
                      {
                          uint32_t hint = kInvalidIndex;
                          const size_t end = std::min(samples.size(), (block + 1) * kSamplesPerTask);
                          for (size_t i = block * kSamplesPerTask; i < end; ++i)
                          {
                              result[i] = mapSample(samples[i], hint);
                              if (isRemoved(samples[i]) && result[i].triangle != kInvalidIndex)
                                  hint = result[i].triangle;
                          }
                      });
    return result;
}

std::vector<Moments> mapValuesToSource(const FitMesh& fit_mesh, std::span<const Moments> values,
                                       std::span<const Float3> source_normals)
{
    HEARTH_ASSERT(values.size() == fit_mesh.positions.size() &&
                  source_normals.size() == fit_mesh.bindings.size());
    std::vector<Moments> result(fit_mesh.bindings.size());
    for (size_t v = 0; v < result.size(); ++v)
    {
        const Binding& binding = fit_mesh.bindings[v];
        if (binding.vertices[0] == kInvalidIndex)
        {
            result[v] = openHemisphere(source_normals[v]);
            continue;
        }
        // no sum: 1 * x + 0 * x could change the sign of zero
        if (binding.weights[0] == 1)
        {
            result[v] = values[binding.vertices[0]];
            continue;
        }
        for (size_t k = 0; k < 3; ++k)
        {
            const Moments& corner_value = values[binding.vertices[k]];
            result[v].m0 += binding.weights[k] * corner_value.m0;
            result[v].m1 += corner_value.m1 * binding.weights[k];
        }
    }
    return result;
}

} // namespace hearth::visibility
