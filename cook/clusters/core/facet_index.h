// Which triangles of a group come near a box.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/facet.h"
#include "formats/base/math.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::clusters
{

/// Boxes of the facets, four side by side, under boxes of runs of sixteen. A group's triangles come cluster by cluster,
/// so that runs are compact; and a group asks so rarely that a better tree would cost more than it saves, and that
/// nothing is made before it is asked for.
class FacetIndex
{
public:
    /// positions  three for each facet
    /// places     of the positions, finite
    FacetIndex(std::span<const uint32_t> positions, std::span<const Float3> places)
        : positions_(positions), places_(places)
    {
    }

    Facet facet(uint32_t f) const { return makeFacet(cornerOf(f, 0), cornerOf(f, 1), cornerOf(f, 2)); }

    /// The facets whose boxes touch the given one, ascending, into `found`.
    void query(const Box3& box, std::vector<uint32_t>& found);

private:
    /// Four boxes.
    struct BoxBlock
    {
        LaneVector min;
        LaneVector max;
    };
    Float3 cornerOf(uint32_t f, size_t k) const { return places_[positions_[size_t{f} * 3 + k]]; }
    void makeBoxes();
    static std::vector<BoxBlock> blocksOf(std::span<const Box3> boxes);
    static LaneMask overlap(const BoxBlock& blocks, const Box3& box);

    std::span<const uint32_t> positions_;
    std::span<const Float3> places_;
    std::vector<BoxBlock> boxes_; ///< none before the first query
    std::vector<BoxBlock> run_boxes_;
};

} // namespace hearth::clusters
