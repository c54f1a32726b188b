// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/pages/triangle_walk.h"

#include <algorithm>

namespace hearth::pages
{

using namespace formats;

void TriangleWalk::linkEdges()
{
    for (uint32_t t = 0; t < indices_.size() / 3; ++t)
    {
        const auto [a, b, c] = triangleCorners(t);
        // of several triangles at one edge the first is found across it
        const auto link = [&](uint8_t from, uint8_t to, uint32_t opposite)
        {
            uint16_t& other = across_[size_t{from} << 8 | to];
            if (other == kNoEdge)
                other = static_cast<uint16_t>(4 * t + opposite);
        };
        link(a, b, 2);
        link(b, c, 0);
        link(c, a, 1);
    }
}

void TriangleWalk::visit(uint32_t triangle, const WalkStep& step)
{
    visited_[triangle] = 1;
    available_[step.corners[2]] = 1;
    steps_[step_count_++] = step;
}

/// Go over an edge to a triangle that was not visited.
void TriangleWalk::cross(uint8_t edge, uint8_t from, uint8_t to)
{
    const uint32_t there = across(from, to);
    const uint32_t triangle = there / 4;
    visit(triangle, {edge, {from, to, indices_[3 * triangle + there % 4]}});
}

/// Follow the strip: to the right as long as possible, else to the left; then back to the last edge that was
/// left open on the left.
void TriangleWalk::follow(uint32_t triangle)
{
    WalkStep step{kEdgeNone, triangleCorners(triangle)};
    // rotate the first triangle so that the walk can continue to the right
    for (int turn = 0; turn < 2 && !free(step.corners[2], step.corners[1]); ++turn)
        std::rotate(step.corners.begin(), step.corners.begin() + 1, step.corners.end());
    available_[step.corners[0]] = 1;
    available_[step.corners[1]] = 1;
    visit(triangle, step);
    while (true)
    {
        const auto [a, b, c] = steps_[step_count_ - 1].corners;
        if (free(c, b))
        {
            if (free(a, c))
                kept_.push_back({a, c, step_count_});
            cross(kEdgeRight, c, b);
            continue;
        }
        if (free(a, c))
        {
            cross(kEdgeLeft, a, c);
            continue;
        }
        while (!kept_.empty() && !free(kept_.back().from, kept_.back().to))
            kept_.pop_back();
        if (kept_.empty())
            return;
        const KeptEdge kept = kept_.back();
        kept_.pop_back();
        steps_[kept.step].edge = kEdgeRightPushLeft;
        cross(kEdgePopped, kept.from, kept.to);
    }
}

/// Return the first triangle among those with the most vertices that need not be stored.
uint32_t TriangleWalk::bestStart() const
{
    uint32_t best = 0;
    int best_count = -1;
    for (uint32_t t = 0; t < indices_.size() / 3; ++t)
    {
        if (visited_[t] != 0)
            continue;
        int count = 0;
        for (const uint8_t corner : triangleCorners(t))
            count += available_[corner];
        if (count > best_count)
        {
            best = t;
            best_count = count;
            if (count == 3)
                break;
        }
    }
    return best;
}

std::span<const WalkStep> TriangleWalk::walk(std::span<const uint8_t> indices,
                                             std::span<const uint16_t> known)
{
    indices_ = indices;
    visited_ = {};
    visited_.back() = 1;
    available_ = {};
    for (size_t v = 0; v < known.size(); ++v)
        available_[v] = known[v] != 0 ? 1 : 0;
    step_count_ = 0;
    linkEdges();
    while (step_count_ < indices.size() / 3)
        follow(bestStart());
    for (const WalkStep& step : std::span(steps_).first(step_count_))
    {
        const auto [a, b, c] = step.corners;
        for (const size_t edge : {size_t{a} << 8 | b, size_t{b} << 8 | c, size_t{c} << 8 | a})
            across_[edge] = kNoEdge;
    }
    return std::span(steps_).first(step_count_);
}

std::span<const WalkStep> TriangleWalk::replay(std::span<const uint8_t> indices,
                                               std::span<const uint8_t> codes)
{
    indices_ = indices;
    step_count_ = static_cast<uint32_t>(indices.size() / 3);
    for (uint32_t t = 0; t < step_count_; ++t)
    {
        const uint32_t code = t == 0 ? kCodeRestart : uint32_t{codes[(t - 1) / 2]} >> ((t - 1) % 2 * 4) & 15u;
        steps_[t] = {code == kCodeRestart ? kEdgeNone : static_cast<uint8_t>(code / 3), triangleCorners(t)};
    }
    return std::span(steps_).first(step_count_);
}

} // namespace hearth::pages
