// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/fit/refined_levels.h"

#include "formats/base/assert.h"
#include "formats/gpu_shared/visibility_cone.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>

namespace hearth::visibility
{

namespace
{

// Share of the open hemisphere's m0; above it the closed form is the hemisphere, and nothing can be nearer.
constexpr float kMaxRefinedShare = 0.9999f;

/// First and second moments of a vertex: m0, m1, and xx, yy, xy, xz, yz; zz is the rest of m0.
using VertexMoments = std::array<float, 9>;

Sh9 computeHarmonics(const VertexMoments& vertex_moments)
{
    std::array<double, 9> wide{};
    std::copy(vertex_moments.begin(), vertex_moments.end(), wide.begin());
    const auto& [m0, x, y, z, xx, yy, xy, xz, yz] = wide;
    const double band1 = std::sqrt(3 / (4 * std::numbers::pi)),
                 band2 = std::sqrt(15 / (4 * std::numbers::pi));
    const double zz = m0 - xx - yy;
    return {m0 / std::sqrt(4 * std::numbers::pi),
            band1 * y,
            band1 * z,
            band1 * x,
            band2 * xy,
            band2 * yz,
            band2 * (2 * zz - xx - yy) / (2 * std::numbers::sqrt3),
            band2 * xz,
            band2 * (xx - yy) / 2};
}

/// Compute m0 = 2 pi s (1 - c), m1 = pi s (1 - c^2) d.
Moments momentsFromCone(const ConeFit& cone)
{
    const double c = std::cos(cone.aperture_rad), size = std::numbers::pi * cone.scale * (1 - c * c);
    return {static_cast<float>(2 * std::numbers::pi * cone.scale * (1 - c)),
            {static_cast<float>(size * cone.axis.x), static_cast<float>(size * cone.axis.y),
             static_cast<float>(size * cone.axis.z)}};
}

/// Return the vertices to refine, with vertices of equal moments next to each other.
std::vector<uint32_t> groupEqualMoments(const LevelMesh& level, std::span<const VertexMoments> vertex_moments)
{
    std::vector<uint32_t> order;
    for (uint32_t v = 0; v < vertex_moments.size(); ++v)
    {
        const bool held = !level.finer_vertex.empty() && level.finer_vertex[v] != kInvalidIndex;
        if (!held && vertex_moments[v][0] > 0 &&
            vertex_moments[v][0] < kMaxRefinedShare * 2 * static_cast<float>(std::numbers::pi))
            order.push_back(v);
    }
    std::sort(order.begin(), order.end(),
              [&](uint32_t a, uint32_t b)
              { return std::tie(vertex_moments[a], a) < std::tie(vertex_moments[b], b); });
    return order;
}

/// Refine the cones of one level. Adds squares of distances to the statistics.
void refine(const LevelMesh& level, std::span<const VertexMoments> vertex_moments,
            std::vector<Moments>& moments, RefineGain& gain)
{
    const std::vector<uint32_t> order = groupEqualMoments(level, vertex_moments);
    std::vector<uint32_t> number(order.size());
    std::vector<Sh9> visibility;
    std::vector<ConeFit> starts;
    std::vector<Float3> normals;
    for (size_t i = 0; i < order.size(); ++i)
    {
        const uint32_t v = order[i];
        if (i == 0 || vertex_moments[v] != vertex_moments[order[i - 1]])
        {
            const Float3 normal = level.mesh.normals[v];
            const shared::VisibilityCone cone = shared::visibilityCone(moments[v].m0, moments[v].m1, normal);
            visibility.push_back(computeHarmonics(vertex_moments[v]));
            starts.push_back({widen(cone.axis), double{cone.aperture}, double{cone.scale}});
            normals.push_back(normal);
        }
        number[i] = static_cast<uint32_t>(visibility.size() - 1);
    }
    const RefinedCones refined = refineCones(visibility, starts, normals);
    for (size_t i = 0; i < order.size(); ++i)
        moments[order[i]] = momentsFromCone(refined.cones[number[i]]);
    const auto count = static_cast<double>(visibility.size());
    gain.cones += visibility.size();
    gain.statistics.start_rms += count * refined.statistics.start_rms * refined.statistics.start_rms;
    gain.statistics.rms += count * refined.statistics.rms * refined.statistics.rms;
}

} // namespace

RefineGain refineLevels(std::span<const LevelMesh> levels, std::span<const SurfaceSample> samples,
                        std::span<const SecondMoments> second, const LevelFitSettings& settings,
                        std::vector<LevelFit>& fits)
{
    HEARTH_ASSERT(fits.size() == levels.size() && second.size() == samples.size());
    // five more numbers in two fits of four
    std::vector<Moments> first_half, second_half;
    for (const SecondMoments& m : second)
    {
        first_half.push_back({m.xx, {m.xy, m.xz, m.yz}});
        second_half.push_back({m.yy, {}});
    }
    LevelFitSettings any = settings;
    any.fit.clamp = false;
    const std::vector<LevelFit> a = fitLevels(levels, samples, first_half, any),
                                b = fitLevels(levels, samples, second_half, any);
    RefineGain gain;
    for (size_t l = 0; l < levels.size(); ++l)
    {
        std::vector<VertexMoments> vertex_moments(fits[l].moments.size());
        for (size_t v = 0; v < vertex_moments.size(); ++v)
        {
            const Moments &m = fits[l].moments[v], &x = a[l].moments[v], &y = b[l].moments[v];
            vertex_moments[v] = {m.m0, m.m1.x, m.m1.y, m.m1.z, x.m0, y.m0, x.m1.x, x.m1.y, x.m1.z};
        }
        refine(levels[l], vertex_moments, fits[l].moments, gain);
        for (size_t v = 0; v < levels[l].finer_vertex.size(); ++v)
            if (levels[l].finer_vertex[v] != kInvalidIndex)
                fits[l].moments[v] = fits[l - 1].moments[levels[l].finer_vertex[v]];
    }
    const double count = std::max<double>(1, static_cast<double>(gain.cones));
    gain.statistics.start_rms = std::sqrt(gain.statistics.start_rms / count);
    gain.statistics.rms = std::sqrt(gain.statistics.rms / count);
    return gain;
}

} // namespace hearth::visibility
