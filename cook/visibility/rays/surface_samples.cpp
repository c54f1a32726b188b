// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/rays/surface_samples.h"

#include "cook/sampling/maps.h"
#include "cook/sampling/owen_sobol.h"
#include "formats/base/assert.h"
#include "formats/base/double3.h"

#include <algorithm>
#include <array>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>
#include <tuple>

namespace hearth::visibility
{

namespace
{

// Maximum share of all samples for the minimum counts of vertices; the rest is distributed by area.
constexpr double kMaxVertexShare = 0.9;

using Corners = std::array<Float3, 3>;

Corners triangleCorners(std::span<const Float3> positions, std::span<const uint32_t> corners, size_t triangle)
{
    return {positions[corners[triangle * 3]], positions[corners[triangle * 3 + 1]],
            positions[corners[triangle * 3 + 2]]};
}

double triangleArea(const Corners& c)
{
    return length(cross(widen(c[1]) - widen(c[0]), widen(c[2]) - widen(c[0]))) / 2;
}

/// Z-order (Morton) curve through a grid of 2^21 cells a side that covers all positions.
class MortonCurve
{
public:
    explicit MortonCurve(std::span<const Float3> positions)
    {
        Box3 box;
        for (const Float3 p : positions)
            box.add(p);
        origin_ = widen(box.min);
        double extent = 0;
        for (int axis = 0; axis < 3; ++axis)
            extent = std::max(extent, double{box.max[axis]} - double{box.min[axis]});
        cells_per_metre_ = extent > 0 ? 2097151.0 / extent : 0;
    }

    uint64_t code(Double3 p) const
    {
        const Double3 cell = (p - origin_) * cells_per_metre_;
        return spreadBits(cell.x) | spreadBits(cell.y) << 1 | spreadBits(cell.z) << 2;
    }

private:
    /// Insert two zero bits after each of the lower 21 bits.
    static uint64_t spreadBits(double cell)
    {
        auto x = static_cast<uint64_t>(std::clamp(cell, 0.0, 2097151.0));
        x = (x | x << 32) & 0x001F00000000FFFFu;
        x = (x | x << 16) & 0x001F0000FF0000FFu;
        x = (x | x << 8) & 0x100F00F00F00F00Fu;
        x = (x | x << 4) & 0x10C30C30C30C30C3u;
        return (x | x << 2) & 0x1249249249249249u;
    }

    Double3 origin_;
    double cells_per_metre_ = 0;
};

/// Item with its code on the curve; equal codes are ordered by item, so that the order is the same in every
/// run.
struct CurveItem
{
    uint64_t code;
    uint64_t item;
    friend auto operator<=>(const CurveItem&, const CurveItem&) = default;
};

/// Compute the minimum number of samples of each triangle with area. `total`: number of all samples.
std::vector<double> minCounts(std::span<const uint32_t> corners, std::span<const double> areas,
                              const SurfaceSampleSettings& settings, size_t vertex_count, double total)
{
    std::vector<uint32_t> degrees(vertex_count, 0);
    for (size_t i = 0; i < corners.size(); ++i)
        degrees[corners[i]] += areas[i / 3] > 0;
    std::vector<double> min_counts(areas.size(), 0);
    double floor = 0, more = 0;
    for (size_t t = 0; t < areas.size(); ++t)
    {
        if (!(areas[t] > 0))
            continue;
        const uint32_t degree =
            std::min({degrees[corners[t * 3]], degrees[corners[t * 3 + 1]], degrees[corners[t * 3 + 2]]});
        min_counts[t] = std::max<double>(settings.min_per_triangle, settings.min_per_vertex / degree);
        floor += settings.min_per_triangle;
        more += min_counts[t] - settings.min_per_triangle;
    }
    const double share = more > 0 ? std::clamp((kMaxVertexShare * total - floor) / more, 0.0, 1.0) : 0;
    for (double& count : min_counts)
        if (count > 0)
            count = settings.min_per_triangle + share * (count - settings.min_per_triangle);
    return min_counts;
}

/// Compute the samples per square metre for which all counts, raised to the triangles' minimums, sum to
/// `total`.
double solveDensity(std::span<const double> areas, std::span<const double> min_counts, double total)
{
    struct Triangle
    {
        double density; ///< density above which the area decides
        size_t index;
    };
    std::vector<Triangle> sorted;
    double area_left = 0;
    for (size_t t = 0; t < areas.size(); ++t)
        if (areas[t] > 0)
        {
            sorted.push_back({min_counts[t] / areas[t], t});
            area_left += areas[t];
        }
    std::sort(sorted.begin(), sorted.end(),
              [](const Triangle& a, const Triangle& b)
              { return std::tie(b.density, a.index) < std::tie(a.density, b.index); });
    double samples_left = total;
    for (const Triangle& triangle : sorted)
    {
        // the triangle with the greatest need for its area gets its share by area, or else its minimum and is
        // done
        if (samples_left <= 0 || samples_left >= triangle.density * area_left)
            break;
        samples_left -= min_counts[triangle.index];
        area_left -= areas[triangle.index];
    }
    return samples_left > 0 && area_left > 0 ? samples_left / area_left : 0;
}

/// Count samples along the curve: if rounding gives a triangle too many, its neighbour gets fewer.
std::vector<uint32_t> countSamples(std::span<const double> areas, std::span<const double> min_counts,
                                   std::span<const CurveItem> order, double total)
{
    const double density = solveDensity(areas, min_counts, total);
    std::vector<uint32_t> counts(areas.size());
    double carried = 0.5;
    for (const CurveItem& place : order)
    {
        const double area = areas[place.item];
        if (!(area > 0))
            continue;
        carried += std::max(density * area, min_counts[place.item]);
        const double count = std::floor(carried);
        counts[place.item] = static_cast<uint32_t>(count);
        carried -= count;
    }
    return counts;
}

} // namespace

std::vector<SurfaceSample> surfaceSamples(std::span<const Float3> positions,
                                          std::span<const uint32_t> corners,
                                          const SurfaceSampleSettings& settings)
{
    HEARTH_ASSERT(corners.size() % 3 == 0 && settings.min_per_triangle > 0);
    HEARTH_ASSERT(settings.samples_per_vertex >= 0);
    for (const uint32_t corner : corners)
        HEARTH_ASSERT(corner < positions.size());
    const size_t triangle_count = corners.size() / 3;
    const MortonCurve curve(positions);

    // Count by area, in the order of the curve.
    std::vector<double> areas(triangle_count);
    std::vector<CurveItem> order(triangle_count);
    tbb::parallel_for(size_t{0}, triangle_count,
                      [&](size_t t)
                      {
                          const Corners c = triangleCorners(positions, corners, t);
                          areas[t] = triangleArea(c);
                          order[t] = {curve.code((widen(c[0]) + widen(c[1]) + widen(c[2])) * (1.0 / 3)), t};
                      });
    tbb::parallel_sort(order);
    const double total = settings.samples_per_vertex * static_cast<double>(positions.size());
    const std::vector<double> min_counts = minCounts(corners, areas, settings, positions.size(), total);
    const std::vector<uint32_t> counts = countSamples(areas, min_counts, order, total);

    // Generate a low-discrepancy net of points in each triangle.
    std::vector<size_t> first(triangle_count + 1);
    for (size_t t = 0; t < triangle_count; ++t)
        first[t + 1] = first[t] + counts[t];
    std::vector<SurfaceSample> samples(first.back());
    std::vector<CurveItem> sample_order(samples.size());
    tbb::parallel_for(size_t{0}, triangle_count,
                      [&](size_t t)
                      {
                          const Corners c = triangleCorners(positions, corners, t);
                          const uint64_t seed = sampling::deriveSeed(settings.seed, t);
                          for (uint32_t i = 0; i < counts[t]; ++i)
                          {
                              const Float2 at =
                                  sampling::trianglePoint(sampling::unitPoint(sampling::owenSobol(i, seed)));
                              samples[first[t] + i] = {static_cast<uint32_t>(t), at.x, at.y,
                                                       static_cast<float>(areas[t] / counts[t])};
                              const Double3 a = widen(c[0]);
                              const Double3 place =
                                  a + (widen(c[1]) - a) * double{at.x} + (widen(c[2]) - a) * double{at.y};
                              sample_order[first[t] + i] = {curve.code(place), first[t] + i};
                          }
                      });
    tbb::parallel_sort(sample_order);
    std::vector<SurfaceSample> sorted(samples.size());
    for (size_t i = 0; i < samples.size(); ++i)
        sorted[i] = samples[sample_order[i].item];
    return sorted;
}

} // namespace hearth::visibility
