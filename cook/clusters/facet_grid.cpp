// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/facet_grid.h"

#include <algorithm>
#include <cmath>

namespace hearth::clusters
{

namespace
{

// Cells about as large as a triangle's box: a query then meets a handful of triangles in a handful of cells.
constexpr int32_t kMaxCellsPerAxis = 32;

bool overlap(const Box3& a, const Box3& b)
{
    return a.min.x <= b.max.x && a.max.x >= b.min.x && a.min.y <= b.max.y && a.max.y >= b.min.y &&
           a.min.z <= b.max.z && a.max.z >= b.min.z;
}

} // namespace

FacetGrid::FacetGrid(std::span<const Float3> places) : stamp_(places.size() / 3, 0)
{
    Box3 all;
    float size_sum = 0;
    facets_.reserve(places.size() / 3);
    boxes_.reserve(places.size() / 3);
    for (size_t i = 0; i < places.size(); i += 3)
    {
        facets_.push_back(makeFacet(places[i], places[i + 1], places[i + 2]));
        Box3 box;
        for (size_t k = 0; k < 3; ++k)
            box.add(places[i + k]);
        boxes_.push_back(box);
        all.add(box);
        const Float3 extent = box.max - box.min;
        size_sum += std::max({extent.x, extent.y, extent.z});
    }
    const Float3 extent = all.max - all.min;
    const float longest = std::max({extent.x, extent.y, extent.z});
    const float cell = std::max({size_sum / static_cast<float>(facets_.size()),
                                 longest / static_cast<float>(kMaxCellsPerAxis), 1e-6f});
    origin_ = all.min;
    cells_per_unit_ = 1 / cell;
    for (int axis = 0; axis < 3; ++axis)
        size_[axis] =
            std::clamp(static_cast<int32_t>(extent[axis] * cells_per_unit_) + 1, 1, kMaxCellsPerAxis);

    offsets_.assign(cellAt(0, 0, size_[2]) + 1, 0);
    for (const Box3& box : boxes_)
        forEachCell(box, [&](size_t cell_number) { ++offsets_[cell_number + 1]; });
    for (size_t i = 1; i < offsets_.size(); ++i)
        offsets_[i] += offsets_[i - 1];
    items_.resize(offsets_.back());
    std::vector<uint32_t> next(offsets_.begin(), offsets_.end() - 1);
    for (uint32_t f = 0; f < boxes_.size(); ++f)
        forEachCell(boxes_[f], [&](size_t cell_number) { items_[next[cell_number]++] = f; });
}

FacetGrid::Cells FacetGrid::cellsOf(const Box3& box) const
{
    Cells cells;
    for (int axis = 0; axis < 3; ++axis)
    {
        const auto last = static_cast<float>(size_[axis] - 1);
        const float low = (box.min[axis] - origin_[axis]) * cells_per_unit_;
        const float high = (box.max[axis] - origin_[axis]) * cells_per_unit_;
        cells.low[axis] = static_cast<int32_t>(std::clamp(low, 0.0f, last));
        cells.high[axis] = static_cast<int32_t>(std::clamp(high, 0.0f, last));
    }
    return cells;
}

void FacetGrid::query(const Box3& box, std::vector<uint32_t>& found)
{
    found.clear();
    ++stamp_value_;
    forEachCell(box,
                [&](size_t cell)
                {
                    for (uint32_t i = offsets_[cell]; i < offsets_[cell + 1]; ++i)
                    {
                        const uint32_t f = items_[i];
                        if (stamp_[f] == stamp_value_ || !overlap(boxes_[f], box))
                            continue;
                        stamp_[f] = stamp_value_;
                        found.push_back(f);
                    }
                });
}

} // namespace hearth::clusters
