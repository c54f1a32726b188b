// Which triangles of a group come near a box: a uniform grid over the group's cube.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/facet.h"
#include "formats/math.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::clusters
{

class FacetGrid
{
public:
    /// places  three for each facet, in [-1, 1]^3
    explicit FacetGrid(std::span<const Float3> places);

    size_t facetCount() const { return facets_.size(); }
    const Facet& facet(uint32_t number) const { return facets_[number]; }

    /// The facets whose boxes touch the given one, each once, into `found`.
    void query(const Box3& box, std::vector<uint32_t>& found);

private:
    struct Cells
    {
        int32_t low[3];
        int32_t high[3];
    };
    Cells cellsOf(const Box3& box) const;
    size_t cellAt(int32_t x, int32_t y, int32_t z) const
    {
        return (static_cast<size_t>(z) * static_cast<size_t>(size_[1]) + static_cast<size_t>(y)) *
                   static_cast<size_t>(size_[0]) +
               static_cast<size_t>(x);
    }

    template <typename Visit>
    void forEachCell(const Box3& box, Visit visit) const
    {
        const Cells cells = cellsOf(box);
        for (int32_t z = cells.low[2]; z <= cells.high[2]; ++z)
            for (int32_t y = cells.low[1]; y <= cells.high[1]; ++y)
                for (int32_t x = cells.low[0]; x <= cells.high[0]; ++x)
                    visit(cellAt(x, y, z));
    }

    std::vector<Facet> facets_;
    std::vector<Box3> boxes_;
    Float3 origin_;
    float cells_per_unit_ = 1;
    int32_t size_[3] = {1, 1, 1};
    std::vector<uint32_t> offsets_;
    std::vector<uint32_t> items_;
    std::vector<uint32_t> stamp_;
    uint32_t stamp_value_ = 0;
};

} // namespace hearth::clusters
