// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/triangle_walk.h"

#include <algorithm>

namespace hearth::clusters
{

using namespace formats;

void TriangleWalk::linkEdges()
{
    for (uint32_t t = 0; t < indices_.size() / 3; ++t)
    {
        const auto corners = cornersOf(t);
        for (size_t i = 0; i < 3; ++i)
        {
            uint8_t& other = across_[size_t{corners[i]} << 8 | corners[(i + 1) % 3]];
            // of several triangles at one edge the first is met across it
            if (other == 0)
                other = static_cast<uint8_t>(t + 1);
        }
    }
}

std::array<uint8_t, 3> TriangleWalk::turned(uint32_t triangle, uint8_t first, uint8_t second) const
{
    auto corners = cornersOf(triangle);
    for (int turn = 0; turn < 2 && !(corners[0] == first && corners[1] == second); ++turn)
        std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    return corners;
}

void TriangleWalk::visit(uint32_t triangle, const WalkStep& step)
{
    visited_[triangle] = 1;
    for (const uint8_t corner : step.corners)
        placed_[corner] = 1;
    steps_.push_back(step);
}

/// To the right as long as that goes, else to the left; then back to the last edge that was passed by on the left.
void TriangleWalk::follow(uint32_t triangle)
{
    WalkStep step{kEdgeNone, cornersOf(triangle)};
    // so that the walk can go on to the right
    for (int turn = 0; turn < 2 && !free(across(step.corners[2], step.corners[1])); ++turn)
        std::rotate(step.corners.begin(), step.corners.begin() + 1, step.corners.end());
    visit(triangle, step);
    while (true)
    {
        const auto [a, b, c] = steps_.back().corners;
        const uint32_t right = across(c, b);
        const uint32_t left = across(a, c);
        if (free(right))
        {
            if (free(left))
                kept_.push_back({a, c, static_cast<uint32_t>(steps_.size())});
            visit(right - 1, {kEdgeRight, turned(right - 1, c, b)});
            continue;
        }
        if (free(left))
        {
            visit(left - 1, {kEdgeLeft, turned(left - 1, a, c)});
            continue;
        }
        while (!kept_.empty() && !free(across(kept_.back().from, kept_.back().to)))
            kept_.pop_back();
        if (kept_.empty())
            return;
        const Kept kept = kept_.back();
        kept_.pop_back();
        steps_[kept.step].edge = kEdgeRightKeepLeft;
        const uint32_t next = across(kept.from, kept.to) - 1;
        visit(next, {kEdgeKept, turned(next, kept.from, kept.to)});
    }
}

/// The first of those with the most vertices that need not be stored.
uint32_t TriangleWalk::bestStart(std::span<const uint16_t> known) const
{
    uint32_t best = 0;
    int best_count = -1;
    for (uint32_t t = 0; t < indices_.size() / 3; ++t)
    {
        if (visited_[t] != 0)
            continue;
        int count = 0;
        for (const uint8_t corner : cornersOf(t))
            count += placed_[corner] != 0 || known[corner] != 0 ? 1 : 0;
        if (count > best_count)
        {
            best = t;
            best_count = count;
        }
    }
    return best;
}

std::span<const WalkStep> TriangleWalk::walk(std::span<const uint8_t> indices,
                                             std::span<const uint16_t> known)
{
    indices_ = indices;
    visited_ = {};
    placed_ = {};
    steps_.clear();
    linkEdges();
    while (steps_.size() < indices.size() / 3)
        follow(bestStart(known));
    for (uint32_t t = 0; t < indices.size() / 3; ++t)
    {
        const auto corners = cornersOf(t);
        for (size_t i = 0; i < 3; ++i)
            across_[size_t{corners[i]} << 8 | corners[(i + 1) % 3]] = 0;
    }
    return steps_;
}

} // namespace hearth::clusters
