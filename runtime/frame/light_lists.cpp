// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/frame/light_lists.h"

#include "formats/base/assert.h"

#include <algorithm>

namespace hearth::shared
{

namespace
{

/// Values of an edge of columns or rows for a cone, computed when first needed.
constexpr uint8_t kEdgeKnown = 1;
constexpr uint8_t kBehindGreater = 2; ///< the cone is behind the edge for cells at greater coordinates
constexpr uint8_t kBehindSmaller = 4;

/// Depth of a tangent that is not yet computed.
constexpr float kUnknownDepth = -2;

uint32_t slabNumber(const LightGridLayout& layout, float depth)
{
    const LightCascade& cascade = layout.cascades[lightCascadeAt(depth)];
    return cascade.first_slab + lightSlabAt(cascade, depth);
}

/// Whole numbers of the rows between two values of v, clamped to the rows of the cascade.
struct RowRange
{
    uint32_t first;
    uint32_t end;
};

RowRange rowsBetween(const LightGridLayout& layout, const LightCascade& cascade, float low, float high)
{
    const float rows = static_cast<float>(cascade.rows);
    const float first = (low - layout.grid.edges.z) * cascade.rows_per_v;
    const float last = (high - layout.grid.edges.z) * cascade.rows_per_v;
    if (!(last >= 0 && first < rows))
        return {0, 0};
    return {static_cast<uint32_t>(std::max(first, 0.0f)),
            static_cast<uint32_t>(std::min(last, rows - 1)) + 1};
}

uint8_t edgeBits(const LightGrid& grid, const CellLight& light, float apex, float axis, float edge)
{
    return kEdgeKnown | (isSectorBehindEdge(grid, light, apex, axis, edge, 1) ? kBehindGreater : uint8_t{0}) |
           (isSectorBehindEdge(grid, light, apex, axis, edge, -1) ? kBehindSmaller : uint8_t{0});
}

} // namespace

void LightLists::listLights(const LightGridLayout& layout, std::span<const Light> lights,
                            const LightListView& lists)
{
    HEARTH_ASSERT(lights.size() <= kMaxLights && lists.frame.size() >= lights.size());
    const LightGrid& grid = layout.grid;
    *lists.counts = {};
    for (uint32_t i = 0; i < lights.size(); ++i)
        if (isUnrangedLight(lights[i]) && !isLightOff(lights[i]))
            lists.frame[lists.counts->unranged++] = i;
    ranged_.clear();
    for (uint32_t i = 0; i < lights.size(); ++i)
    {
        if (isUnrangedLight(lights[i]) || isLightOff(lights[i]))
            continue;
        CellLight light = makeCellLight(grid, lights[i]);
        if (!isLightInView(grid, light))
            continue;
        light.first_slab = slabNumber(layout, std::max(light.center.z - light.radius, grid.z_near));
        light.last_slab = slabNumber(layout, std::max(light.center.z + light.radius, grid.z_near));
        lists.frame[lists.counts->unranged + ranged_.size()] = i;
        ranged_.push_back(light);
    }
    lists.counts->ranged = static_cast<uint32_t>(ranged_.size());
}

void LightLists::assign(const LightGridLayout& layout, std::span<const Light> lights,
                        const LightListView& lists)
{
    HEARTH_ASSERT(lists.cells.size() >= layout.grid.cell_count);
    listLights(layout, lights, lists);
    runs_.clear();
    counts_.assign(layout.grid.cell_count, 0);
    for (size_t place = 0; place < ranged_.size(); ++place)
        addLight(layout, ranged_[place], static_cast<uint16_t>(place));
    writeIndices(lists);
}

void LightLists::BallRows::begin(const LightGrid& grid, const CellLight& light)
{
    light_ = light;
    ball_ = lightBall(light);
    ball_tangents_ = lightBallTangents(grid, light, ball_);
}

void LightLists::BallRows::beginCascade(const LightCascade& cascade)
{
    edge_tangents_.assign(cascade.rows + 1, {0, kUnknownDepth, 0, kUnknownDepth});
    row_tangents_.assign(cascade.rows, {0, kUnknownDepth, 0, kUnknownDepth});
    chords_.resize(cascade.rows);
    rows_ = last_rows_ = {};
}

/// Rows of a slab come in rising order without gaps.
LightColumns LightLists::BallRows::find(const LightGrid& grid, const LightCascade& cascade,
                                        const LightSlab& slab, uint32_t number, const LightRow& row)
{
    for (const uint32_t edge : {number, number + 1})
        if (edge_tangents_[edge].depth0 == kUnknownDepth)
            edge_tangents_[edge] =
                lightEdgeTangents(grid, light_, ball_, edge == number ? row.begin : row.end);
    if (row_tangents_[number].depth0 == kUnknownDepth)
        row_tangents_[number] = tangentsInRow(grid, light_, ball_tangents_, row);
    LightSpan& end_chord = chords_[number];
    const bool is_known = number >= last_rows_.first && number < last_rows_.end;
    LightSpan span = is_known ? end_chord : lightChord(grid, light_, ball_, slab.begin, row);
    end_chord = lightChord(grid, light_, ball_, slab.end, row);
    rows_ = {rows_.end == 0 ? number : rows_.first, number + 1};
    span = joinSpans(span, end_chord);
    span = addTangents(span, edge_tangents_[number], slab);
    span = addTangents(span, edge_tangents_[number + 1], slab);
    span = addTangents(span, row_tangents_[number], slab);
    return spanColumns(grid, cascade, span);
}

void LightLists::addLight(const LightGridLayout& layout, const CellLight& light, uint16_t place)
{
    const LightGrid& grid = layout.grid;
    const bool is_cone = light.cosine >= 0;
    ball_.begin(grid, light);
    if (is_cone)
        range_ball_.begin(grid, rangeBall(light));
    const uint32_t first = light.first_slab;
    const uint32_t last = light.last_slab;
    for (const LightCascade& cascade : layout.cascades)
    {
        if (cascade.first_slab + cascade.slabs <= first || cascade.first_slab > last)
            continue;
        ball_.beginCascade(cascade);
        if (is_cone)
        {
            range_ball_.beginCascade(cascade);
            beside_columns_.assign(cascade.columns + 1, 0);
            beside_rows_.assign(cascade.rows + 1, 0);
        }
        const uint32_t begin_slab = std::max(first, cascade.first_slab) - cascade.first_slab;
        const uint32_t end_slab = std::min(last + 1 - cascade.first_slab, cascade.slabs);
        for (uint32_t number = begin_slab; number < end_slab; ++number)
        {
            const LightSlab slab = lightSlab(grid, cascade, number);
            ball_.beginSlab();
            range_ball_.beginSlab();
            if (slab.end <= slab.begin || (is_cone && isSectorOutsideSlab(light, slab)))
                continue;
            const LightBounds bounds = lightBounds(grid, light, slab);
            const RowRange rows = rowsBetween(layout, cascade, bounds.edges.z, bounds.edges.w);
            const uint32_t slab_cell = cascade.first_cell + number * cascade.rows * cascade.columns;
            for (uint32_t r = rows.first; r < rows.end; ++r)
            {
                const LightRow row{lightRowEdge(grid, cascade, r), lightRowEdge(grid, cascade, r + 1)};
                LightColumns columns = ball_.find(grid, cascade, slab, r, row);
                if (is_cone)
                    columns = intersectColumns(columns, range_ball_.find(grid, cascade, slab, r, row));
                if (columns.first <= columns.last)
                    addRow(layout, cascade, light, slab, slab_cell, r, columns, place);
            }
        }
    }
}

/// Add the cells of a row that a ball covers, as far as the cone reaches them.
void LightLists::addRow(const LightGridLayout& layout, const LightCascade& cascade, const CellLight& light,
                        const LightSlab& slab, uint32_t slab_cell, uint32_t row, LightColumns columns,
                        uint16_t place)
{
    const LightGrid& grid = layout.grid;
    const uint32_t row_cell = slab_cell + row * cascade.columns;
    const auto add = [&](int first, int last)
    {
        if (first > last)
            return;
        runs_.push_back(
            {row_cell + static_cast<uint32_t>(first), static_cast<uint16_t>(last - first + 1), place});
        for (int c = first; c <= last; ++c)
            ++counts_[row_cell + static_cast<uint32_t>(c)];
    };
    if (light.cosine < 0)
        return add(columns.first, columns.last);

    const auto rowBits = [&](uint32_t edge)
    {
        if (beside_rows_[edge] == 0)
            beside_rows_[edge] =
                edgeBits(grid, light, light.apex.y, light.axis.y, lightRowEdge(grid, cascade, edge));
        return beside_rows_[edge];
    };
    const auto columnBits = [&](uint32_t edge)
    {
        if (beside_columns_[edge] == 0)
            beside_columns_[edge] =
                edgeBits(grid, light, light.apex.x, light.axis.x, lightColumnEdge(grid, cascade, edge));
        return beside_columns_[edge];
    };
    if ((rowBits(row) & kBehindGreater) != 0 || (rowBits(row + 1) & kBehindSmaller) != 0)
        return;
    const float v_begin = lightRowEdge(grid, cascade, row);
    const float v_end = lightRowEdge(grid, cascade, row + 1);
    int first = columns.first;
    for (int c = columns.first; c <= columns.last; ++c)
    {
        const auto column = static_cast<uint32_t>(c);
        const bool reaches = (columnBits(column) & kBehindGreater) == 0 &&
                             (columnBits(column + 1) & kBehindSmaller) == 0 &&
                             !isCellBesideCone(grid, light, slab,
                                               {lightColumnEdge(grid, cascade, column),
                                                lightColumnEdge(grid, cascade, column + 1), v_begin, v_end});
        if (reaches)
            continue;
        add(first, c - 1);
        first = c + 1;
    }
    add(first, columns.last);
}

void LightLists::writeIndices(const LightListView& lists)
{
    ends_.resize(counts_.size());
    uint32_t words = 0;
    const auto capacity = static_cast<uint32_t>(lists.indices.size());
    for (size_t cell = 0; cell < counts_.size(); ++cell)
    {
        const uint32_t count = counts_[cell];
        lists.counts->indices += count;
        lists.counts->cells += count > 0 ? 1 : 0;
        const uint32_t word = placeLightList(count, words, capacity);
        lists.cells[cell] = word;
        const bool is_full = lightCellCount(word) == kAllLights;
        lists.counts->overflows += is_full ? 1 : 0;
        ends_[cell] = is_full ? UINT32_MAX : 2 * words;
        words += lightListWords(count);
    }
    lists.counts->index_words = words;
    for (const Run& run : runs_)
        for (uint32_t cell = run.first_cell; cell < run.first_cell + run.cells; ++cell)
        {
            uint32_t& end = ends_[cell];
            if (end == UINT32_MAX)
                continue;
            uint32_t& word = lists.indices[end / 2];
            // the first of a word clears the second, which the last word of an odd list has not
            word = end % 2 == 0 ? run.light : (word | uint32_t{run.light} << 16);
            ++end;
        }
}

} // namespace hearth::shared
