// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/receivers/unwrap/unwrap.h"

#include "cook/receivers/bake/atlas_layout.h"
#include "cook/receivers/unwrap/projection.h"
#include "formats/base/assert.h"
#include "formats/base/index.h"

#include <algorithm>
#include <cmath>

namespace hearth::receivers
{

namespace
{

/// Largest share of overlap of a chart, below kMaxOverlap of a usable UV set.
constexpr double kMaxChartOverlap = 0.005;

/// Points along a texel's side at which overlap is looked for.
constexpr double kOverlapPoints = 2;

/// Texels along a side of the smallest chart (countTexels), and charts that are worth packing: a tree of
/// loose leaves has more, and no texel would show anything of them.
constexpr uint32_t kMinTexels = 2, kMaxCharts = 50'000;

/// Growth of texels while charts do not fit.
constexpr double kTexelGrowth = 1.05;

std::vector<ProjectedChart> makeCharts(std::span<const Float3> positions, std::span<const uint32_t> indices,
                                       double texel_size)
{
    const TriangleGraph graph(positions, indices);
    std::vector<Chart> open = growCharts(graph, texel_size * texel_size);
    std::ranges::reverse(open);
    std::vector<ProjectedChart> charts;
    while (!open.empty())
    {
        ProjectedChart chart = projectChart(positions, indices, graph, std::move(open.back()));
        open.pop_back();
        if (chart.triangles.size() < 2 ||
            measureOverlap(chart, texel_size / kOverlapPoints) <= kMaxChartOverlap)
            charts.push_back(std::move(chart));
        else
            for (Chart& part : splitChart(graph, chart.triangles))
                open.push_back(std::move(part));
    }
    return charts;
}

/// Return the texels of a chart, with room for it to lie between two texels' edges.
RectangleSize countTexels(const ProjectedChart& chart, double texel_size)
{
    const auto side = [&](double size)
    { return static_cast<uint32_t>(std::ceil(std::min(size / texel_size, double{kMaxAtlasSide}) + 0.5)); };
    return {side(chart.width), side(chart.height)};
}

/// Pack charts into a square of UV, with larger texels where they do not fit. nullopt: even the smallest do
/// not.
std::optional<AtlasLayout> packCharts(std::span<const ProjectedChart> charts, double& texel_size)
{
    for (;; texel_size *= kTexelGrowth)
    {
        std::vector<RectangleSize> sizes;
        double area = 0;
        uint32_t largest = 0;
        for (const ProjectedChart& chart : charts)
        {
            const RectangleSize size = sizes.emplace_back(countTexels(chart, texel_size));
            area += double{1} * (size.width + 2 * kAtlasBorder) * (size.height + 2 * kAtlasBorder);
            largest = std::max({largest, size.width, size.height});
        }
        if (area <= double{kMaxRectangleSide} * kMaxRectangleSide)
        {
            std::optional<AtlasLayout> layout = layOutAtlas(sizes);
            if (layout && std::max(layout->width, layout->height) <= kMaxRectangleSide)
                return layout;
        }
        if (largest <= kMinTexels)
            return std::nullopt;
    }
}

/// Vertices of an unwrapped mesh under construction: one for each vertex and chart.
class VertexList
{
public:
    VertexList(Unwrapped& out, size_t old_count) : out_(out), new_from_old_(old_count, kInvalidIndex) {}

    void beginChart() { first_ = static_cast<uint32_t>(out_.old_from_new.size()); }

    uint32_t find(uint32_t old, Float2 uv)
    {
        uint32_t& vertex = new_from_old_[old];
        if (vertex == kInvalidIndex || vertex < first_)
        {
            vertex = static_cast<uint32_t>(out_.old_from_new.size());
            out_.old_from_new.push_back(old);
            out_.uvs.push_back(uv);
        }
        return vertex;
    }

private:
    Unwrapped& out_;
    std::vector<uint32_t> new_from_old_; ///< of the last chart that has it
    uint32_t first_ = 0;                 ///< of the chart
};

} // namespace

std::optional<Unwrapped> unwrap(std::span<const Float3> positions, std::span<const uint32_t> indices,
                                double texel_size)
{
    HEARTH_ASSERT(texel_size > 0);
    const std::vector<ProjectedChart> charts = makeCharts(positions, indices, texel_size);
    if (charts.size() > kMaxCharts)
        return std::nullopt;
    const std::optional<AtlasLayout> packed = packCharts(charts, texel_size);
    if (!packed)
        return std::nullopt;
    const AtlasLayout& layout = *packed;
    Unwrapped out;
    out.chart_count = static_cast<uint32_t>(charts.size());
    out.width = layout.width;
    out.height = layout.height;
    out.indices.assign(indices.size(), kInvalidIndex);
    VertexList vertices(out, positions.size());
    for (size_t c = 0; c < charts.size(); ++c)
    {
        const ProjectedChart& chart = charts[c];
        const RectangleSize size = countTexels(chart, texel_size);
        const double left = layout.places[c].x + (size.width - chart.width / texel_size) / 2;
        const double top = layout.places[c].y + (size.height - chart.height / texel_size) / 2;
        vertices.beginChart();
        for (size_t i = 0; i < chart.triangles.size(); ++i)
            for (size_t corner = 0; corner < 3; ++corner)
            {
                const size_t place = size_t{3} * chart.triangles[i] + corner;
                const Point2 p = chart.corners[i][corner];
                out.indices[place] = vertices.find(
                    indices[place], {static_cast<float>((left + p.x / texel_size) / layout.width),
                                     static_cast<float>((top + p.y / texel_size) / layout.height)});
            }
    }
    vertices.beginChart();
    for (size_t place = 0; place < indices.size(); ++place)
        if (out.indices[place] == kInvalidIndex)
            out.indices[place] = vertices.find(indices[place], {0, 0});
    return out;
}

} // namespace hearth::receivers
