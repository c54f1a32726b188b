// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/fit/finer_levels.h"

#include "cook/mesh/closest_point.h"
#include "cook/visibility/mesh/moment_clamp.h"
#include "formats/base/assert.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tbb/parallel_for.h>

namespace hearth::visibility
{

namespace
{

// Vertices that are looked up in sequence; each search starts at the triangle that the previous one found.
constexpr size_t kVerticesPerTask = 256;

// Minimum cosine between the normal of a vertex and of its triangle on the fitted level, where there is such
// a triangle: 45 degrees. Visibility beyond a hard edge is another one. On a scan whose edges are hard, the
// rms error of ambient occlusion is .019 with it and .028 with 0, on a rough rock the same.
constexpr double kMinCosine = 0.7;

// Minimum cosine between them on a triangle that is as near as the nearest one, but for this share of that
// one's longest edge: 15 degrees. On the edge between two faces at 40 degrees both are as near.
constexpr double kCloseCosine = 0.966, kCloseDistance = 0.01;

/// Moments of the fitted level at any point.
class FittedSurface
{
public:
    FittedSurface(const MeshView& mesh, std::span<const Moments> moments)
        : mesh_(mesh), moments_(moments), closest_(mesh, mesh.triangleCount())
    {
    }

    /// hint  as of ClosestPoint::find; changed to the triangle that was found
    Moments interpolate(Float3 position, Float3 normal, uint32_t& hint) const
    {
        const mesh::ClosestPoint::Hit found = find(position, normal, hint);
        if (found.triangle == kInvalidIndex)
            return openHemisphere(normal);
        hint = found.triangle;
        const uint32_t* corners = &mesh_.indices[size_t{found.triangle} * 3];
        const float weights[3] = {1 - found.u - found.v, found.u, found.v};
        Moments sum;
        Float3 surface_normal;
        for (size_t k = 0; k < 3; ++k)
        {
            sum.m0 += moments_[corners[k]].m0 * weights[k];
            sum.m1 = sum.m1 + moments_[corners[k]].m1 * weights[k];
            surface_normal = surface_normal + mesh_.normals[corners[k]] * weights[k];
        }
        Moments result = tiltHemisphere(sum, normalizeOr(surface_normal, normal), normal);
        clampMoments(result, normal);
        return result;
    }

private:
    mesh::ClosestPoint::Hit find(Float3 position, Float3 normal, uint32_t hint) const
    {
        const mesh::ClosestPoint::Hit found = closest_.findAnywhere(position, normal, hint, kMinCosine);
        if (found.triangle == kInvalidIndex)
            return found;
        const double reach =
            std::sqrt(found.distance2) + kCloseDistance * mesh::longestEdge(mesh_, found.triangle);
        const mesh::ClosestPoint::Hit alike =
            closest_.find(position, normal, reach * reach, found.triangle, kCloseCosine);
        return alike.triangle != kInvalidIndex ? alike : found;
    }

    const MeshView& mesh_;
    std::span<const Moments> moments_;
    mesh::ClosestPoint closest_;
};

/// Interpolate the moments of a level's vertices.
/// coarser, coarser_moments  next coarser level
std::vector<Moments> interpolateLevel(const LevelMesh& level, const LevelMesh& coarser,
                                      std::span<const Moments> coarser_moments, const FittedSurface& surface)
{
    const size_t count = level.mesh.positions.size();
    HEARTH_ASSERT(level.first_copy.size() == count);
    std::vector<Moments> moments(count);
    std::vector<uint8_t> is_shared(count, 0);
    for (size_t v = 0; v < coarser.finer_vertex.size(); ++v)
        if (const uint32_t shared = coarser.finer_vertex[v]; shared != kInvalidIndex)
        {
            moments[shared] = coarser_moments[v];
            is_shared[shared] = 1;
        }
    std::vector<uint8_t> is_known = is_shared;
    for (size_t v = 0; v < count; ++v)
        if (const uint32_t first = level.first_copy[v]; is_shared[v] != 0 && is_known[first] == 0)
        {
            moments[first] = moments[v];
            is_known[first] = 1;
        }
    tbb::parallel_for(size_t{0}, (count + kVerticesPerTask - 1) / kVerticesPerTask,
                      [&](size_t block)
                      {
                          uint32_t hint = kInvalidIndex;
                          const size_t end = std::min(count, (block + 1) * kVerticesPerTask);
                          for (size_t v = block * kVerticesPerTask; v < end; ++v)
                              if (level.first_copy[v] == v && is_known[v] == 0)
                                  moments[v] = surface.interpolate(level.mesh.positions[v],
                                                                   level.mesh.normals[v], hint);
                      });
    for (size_t v = 0; v < count; ++v)
        if (is_shared[v] == 0)
            moments[v] = moments[level.first_copy[v]];
    return moments;
}

} // namespace

Moments tiltHemisphere(const Moments& moments, Float3 from, Float3 to)
{
    // The moments of the open lune between two hemispheres at an angle t are 2 (pi - t) and pi (n + n') / 2.
    constexpr float kPi = std::numbers::pi_v<float>;
    const float angle = std::acos(std::clamp(dot(from, to), -1.0f, 1.0f));
    const float density = moments.m0 / (2 * kPi);
    return {moments.m0 * (1 - angle / kPi), moments.m1 + (to - from) * (density * kPi / 2)};
}

std::vector<std::vector<Moments>> interpolateFinerLevels(std::span<const LevelMesh> levels,
                                                         std::span<const Moments> fitted)
{
    HEARTH_ASSERT(!levels.empty() && levels.back().mesh.positions.size() == fitted.size());
    std::vector<std::vector<Moments>> moments(levels.size() - 1);
    if (moments.empty())
        return moments;
    const FittedSurface surface(levels.back().mesh, fitted);
    std::span<const Moments> coarser = fitted;
    for (size_t level = moments.size(); level-- > 0;)
    {
        moments[level] = interpolateLevel(levels[level], levels[level + 1], coarser, surface);
        coarser = moments[level];
    }
    return moments;
}

} // namespace hearth::visibility
