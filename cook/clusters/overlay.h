// How far a triangle is from a surface that lies over it, measured along the triangle's normal.
// See README.md, "Error".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/star_blocks.h"
#include "cook/clusters/surface.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace hearth::clusters
{

/// Looks at one surface from triangles of another.
class Overlay
{
public:
    /// open   for each position: whether the facets do not close around it
    /// added  for each position, what is added to the heights of the facets around it
    Overlay(const Surface& surface, std::span<const uint8_t> open, std::vector<float> added)
        : surface_(surface),
          open_(open),
          added_(std::move(added)),
          blocks_(surface, open),
          patch_of_center_(open.size(), 0)
    {
    }

    /// Begin a list of centers: the facets around them are the patch that is looked at.
    void clear()
    {
        centers_.clear();
        ++patch_;
    }
    void addCenter(uint32_t position)
    {
        if (std::exchange(patch_of_center_[position], patch_) != patch_)
            centers_.push_back(position);
    }

    /// An upper bound of the distance of any point of the triangle to the patch, and what is added there; infinity
    /// where the patch does not lie over the whole triangle, or turns over there.
    ///
    /// Seen along the triangle's normal both are maps of linear pieces, so that their distance is greatest at a corner
    /// of one of them, or where an edge of one crosses an edge of the other. If no edge of the patch's rim comes over
    /// the triangle, and its corners are covered, all of it is.
    float heightOver(const Corners& triangle) const;

private:
    const Surface& surface_;
    std::span<const uint8_t> open_;
    std::vector<float> added_;
    StarBlocks blocks_;
    std::vector<uint32_t> centers_;
    std::vector<uint32_t> patch_of_center_; ///< for each position, the last patch that it was a center of
    uint32_t patch_ = 0;
};

} // namespace hearth::clusters
