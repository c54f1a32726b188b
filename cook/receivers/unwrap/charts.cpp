// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/receivers/unwrap/charts.h"

#include "formats/base/index.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <queue>
#include <tuple>

namespace hearth::receivers
{

namespace
{

/// Cosines of the angles to a chart's mean normal: up to which it grows, and beyond which a triangle is taken
/// out again, as the normal has turned meanwhile. The texels of a projected triangle are longer on it by the
/// inverse: 1.4 and 2.9.
constexpr double kGrowCosine = 0.7071, kKeepCosine = 0.342;

/// Cosine between a triangle and the plane's normal below which its projection counts as a line.
constexpr double kLineCosine = 0.1;

/// Texels of a chart that a neighbour takes if all of it stays within kKeepCosine: the border of so small a
/// chart costs more than long texels.
constexpr double kSmallTexels = 16;

/// Charts of a mesh while they are made: one for each triangle, or none.
class ChartMap
{
public:
    ChartMap(const TriangleGraph& graph, double texel_area)
        : graph_(graph), texel_area_(texel_area), charts_(graph.triangleCount(), kInvalidIndex)
    {
    }

    /// Grow charts around the largest triangles first, until all triangles have one.
    void grow();

    /// Give small charts to charts beside them, the smallest first.
    void mergeSmallCharts();

    std::vector<Chart> list() const;

private:
    struct Candidate
    {
        double deviation; ///< from the chart's normal when it was met
        uint32_t triangle;
        friend bool operator>(const Candidate& a, const Candidate& b)
        {
            return std::tie(a.deviation, a.triangle) > std::tie(b.deviation, b.triangle);
        }
    };

    void growFrom(uint32_t seed);
    void ejectSteepTriangles(uint32_t chart, Chart triangles);
    uint32_t findTaker(uint32_t chart, const Chart& triangles) const;
    Double3 normal(uint32_t chart) const
    {
        return sums_[chart] * (1 / std::max(length(sums_[chart]), 1e-300));
    }
    void add(uint32_t triangle, uint32_t chart)
    {
        charts_[triangle] = chart;
        sums_[chart] = sums_[chart] + graph_.normals[triangle] * graph_.areas[triangle];
    }

    const TriangleGraph& graph_;
    double texel_area_;
    std::vector<uint32_t> charts_; ///< of triangles
    std::vector<Double3> sums_;    ///< of each chart's normals times areas
};

void ChartMap::growFrom(uint32_t seed)
{
    const auto chart = static_cast<uint32_t>(sums_.size());
    sums_.emplace_back();
    std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> candidates;
    Chart triangles;
    candidates.push({0, seed});
    while (!candidates.empty())
    {
        const uint32_t triangle = candidates.top().triangle;
        candidates.pop();
        if (charts_[triangle] != kInvalidIndex ||
            (!triangles.empty() && dot(graph_.normals[triangle], normal(chart)) < kGrowCosine))
            continue;
        add(triangle, chart);
        triangles.push_back(triangle);
        for (const uint32_t next : graph_.neighbours[triangle])
            if (next != kInvalidIndex && charts_[next] == kInvalidIndex)
                candidates.push({1 - dot(graph_.normals[next], normal(chart)), next});
    }
    ejectSteepTriangles(chart, std::move(triangles));
}

/// Take triangles out of a chart whose normal has turned away from theirs. What is not connected with the
/// seed any longer goes with them.
void ChartMap::ejectSteepTriangles(uint32_t chart, Chart triangles)
{
    const Double3 final_normal = normal(chart);
    const auto is_kept = [&](uint32_t triangle)
    { return dot(graph_.normals[triangle], final_normal) >= kKeepCosine; };
    if (std::ranges::all_of(triangles, is_kept))
        return;
    const uint32_t seed = triangles.front();
    for (const uint32_t triangle : triangles)
        charts_[triangle] = kInvalidIndex;
    sums_[chart] = {};
    std::ranges::sort(triangles);
    // the seed stays in any case, so that each chart has a triangle and growth ends
    Chart open{seed};
    add(seed, chart);
    while (!open.empty())
    {
        const uint32_t triangle = open.back();
        open.pop_back();
        for (const uint32_t next : graph_.neighbours[triangle])
            if (next != kInvalidIndex && charts_[next] == kInvalidIndex &&
                std::ranges::binary_search(triangles, next) && is_kept(next))
            {
                add(next, chart);
                open.push_back(next);
            }
    }
}

void ChartMap::grow()
{
    std::vector<uint32_t> seeds(graph_.triangleCount());
    std::iota(seeds.begin(), seeds.end(), 0u);
    std::ranges::stable_sort(seeds, std::greater<>(), [&](uint32_t t) { return graph_.areas[t]; });
    // A triangle that a chart gave back is a seed again in the next round.
    for (bool is_done = false; !is_done;)
    {
        is_done = true;
        for (const uint32_t seed : seeds)
            if (graph_.areas[seed] > 0 && charts_[seed] == kInvalidIndex)
            {
                is_done = false;
                growFrom(seed);
            }
    }
}

/// Return the chart with the longest border to a chart, among those that may take it.
uint32_t ChartMap::findTaker(uint32_t chart, const Chart& triangles) const
{
    const double texels = length(sums_[chart]) / texel_area_;
    if (texels > kSmallTexels)
        return kInvalidIndex;
    std::map<uint32_t, double> borders; // square roots of areas stand for lengths of edges
    for (const uint32_t triangle : triangles)
        for (const uint32_t next : graph_.neighbours[triangle])
            if (next != kInvalidIndex && charts_[next] != chart)
                borders[charts_[next]] += std::sqrt(graph_.areas[triangle]);
    uint32_t best = kInvalidIndex;
    for (const auto& [other, border] : borders)
    {
        const Double3 sum = sums_[chart] + sums_[other];
        const double keep = kKeepCosine * length(sum);
        // A projected triangle must not be a line, whichever way it faces.
        const auto fits_in = [&](uint32_t triangle)
        {
            const double along = dot(graph_.normals[triangle], sum);
            return along > keep || (texels < 1 && std::abs(along) > kLineCosine * length(sum));
        };
        if (std::ranges::all_of(triangles, fits_in) && length(sums_[other]) >= length(sums_[chart]) &&
            (best == kInvalidIndex || border > borders[best]))
            best = other;
    }
    return best;
}

void ChartMap::mergeSmallCharts()
{
    std::vector<Chart> triangles(sums_.size());
    for (uint32_t triangle = 0; triangle < charts_.size(); ++triangle)
        if (charts_[triangle] != kInvalidIndex)
            triangles[charts_[triangle]].push_back(triangle);
    std::vector<uint32_t> order(sums_.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(order, {}, [&](uint32_t chart) { return length(sums_[chart]); });
    for (const uint32_t chart : order)
    {
        const uint32_t taker = findTaker(chart, triangles[chart]);
        if (taker == kInvalidIndex)
            continue;
        for (const uint32_t triangle : triangles[chart])
            add(triangle, taker);
        triangles[taker].insert(triangles[taker].end(), triangles[chart].begin(), triangles[chart].end());
        triangles[chart].clear();
    }
}

std::vector<Chart> ChartMap::list() const
{
    std::vector<Chart> all(sums_.size());
    for (uint32_t triangle = 0; triangle < charts_.size(); ++triangle)
        if (charts_[triangle] != kInvalidIndex)
            all[charts_[triangle]].push_back(triangle);
    std::erase_if(all, [](const Chart& chart) { return chart.empty(); });
    return all;
}

/// Return each triangle's number of steps from a start within a chart, by the chart's order; kInvalidIndex
/// where none leads to it.
std::vector<uint32_t> countSteps(const TriangleGraph& graph, const Chart& chart, uint32_t start)
{
    std::vector<uint32_t> steps(chart.size(), kInvalidIndex);
    const auto place = [&](uint32_t triangle)
    {
        const auto found = std::ranges::lower_bound(chart, triangle);
        return found != chart.end() && *found == triangle ? static_cast<size_t>(found - chart.begin())
                                                          : chart.size();
    };
    std::queue<uint32_t> open;
    steps[place(start)] = 0;
    open.push(start);
    while (!open.empty())
    {
        const uint32_t triangle = open.front();
        open.pop();
        for (const uint32_t next : graph.neighbours[triangle])
            if (const size_t at = next == kInvalidIndex ? chart.size() : place(next);
                at < chart.size() && steps[at] == kInvalidIndex)
            {
                steps[at] = steps[place(triangle)] + 1;
                open.push(next);
            }
    }
    return steps;
}

} // namespace

std::vector<Chart> growCharts(const TriangleGraph& graph, double texel_area)
{
    ChartMap map(graph, texel_area);
    map.grow();
    map.mergeSmallCharts();
    return map.list();
}

Double3 meanNormal(const TriangleGraph& graph, const Chart& chart)
{
    Double3 sum;
    for (const uint32_t triangle : chart)
        sum = sum + graph.normals[triangle] * graph.areas[triangle];
    const double size = length(sum);
    return size > 0 ? sum * (1 / size) : Double3{0, 0, 1};
}

std::vector<Chart> splitChart(const TriangleGraph& graph, const Chart& chart)
{
    // A place that no step leads to counts as the farthest.
    const auto farthest = [&](const std::vector<uint32_t>& steps)
    { return chart[static_cast<size_t>(std::ranges::max_element(steps) - steps.begin())]; };
    const uint32_t first = farthest(countSteps(graph, chart, chart.front()));
    const std::vector<uint32_t> from_first = countSteps(graph, chart, first);
    const std::vector<uint32_t> from_second = countSteps(graph, chart, farthest(from_first));
    std::vector<Chart> parts(2);
    for (size_t i = 0; i < chart.size(); ++i)
        parts[from_first[i] <= from_second[i] && from_first[i] != kInvalidIndex ? 0 : 1].push_back(chart[i]);
    return parts;
}

} // namespace hearth::receivers
