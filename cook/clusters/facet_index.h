// Which triangles of a group come near a box.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/facet.h"
#include "formats/math.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::clusters
{

/// Boxes of the facets, four side by side, under boxes of runs of sixteen. A group's triangles come cluster by cluster,
/// so that runs are compact; and a group asks so rarely that a better tree would cost more than it saves.
class FacetIndex
{
public:
    /// places  three for each facet, finite
    explicit FacetIndex(std::span<const Float3> places);

    std::span<const Facet> facets() const { return facets_; }

    /// The facets whose boxes touch the given one, ascending, into `found`.
    void query(const Box3& box, std::vector<uint32_t>& found) const;

private:
    /// Four boxes.
    struct BoxBlock
    {
        LaneVector min;
        LaneVector max;
    };
    static std::vector<BoxBlock> blocksOf(std::span<const Box3> boxes);
    static LaneMask overlap(const BoxBlock& blocks, const Box3& box);

    std::vector<Facet> facets_;
    std::vector<BoxBlock> boxes_;
    std::vector<BoxBlock> run_boxes_;
};

} // namespace hearth::clusters
