// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/surface/loop_fill.h"

#include "formats/base/assert.h"

#include <algorithm>

namespace hearth::clusters
{

void LoopFiller::growOrOverflow()
{
    if (chord_count_ == chords_.size())
        chords_.resize(2 * chords_.size());
    if (count_ == kMaxCrossings)
    {
        overflow_ = true;
        count_ = 1;
    }
}

void LoopFiller::addChord(const Crossing& from, float to)
{
    chords_[chord_count_++] = {from.leaving, to - from.t};
    if (chord_count_ == chords_.size())
        growOrOverflow();
}

bool LoopFiller::close()
{
    if (!overflow_)
    {
        // the sentinel 0 is not needed any more
        std::copy(crossings_.begin() + 1, crossings_.begin() + static_cast<ptrdiff_t>(count_),
                  crossings_.begin());
        --count_;
        reduce();
        while (count_ > 0 && (closeRing() || pushOver()))
        {
        }
        if (count_ == 0)
        {
            HEARTH_RUNTIME_ASSERT(chord_count_ < chords_.size());
            crossings_[0] = {};
            return true;
        }
    }
    crossings_[0] = {};
    drop();
    return false;
}

/// True if the path continues around the left corner after a crossing. Else it continues around the right
/// one, or comes back.
bool LoopFiller::turnsLeft(size_t i) const
{
    return crossings_[(i + 1) % count_].leaving == previousHalfEdge(crossings_[i].entering);
}

/// Return the half-edge, in the entered triangle, that starts at the corner to the left or right of the
/// crossing.
HalfEdgeId LoopFiller::cornerAt(const Crossing& crossing, bool left) const
{
    return left ? crossing.entering : nextHalfEdge(crossing.entering);
}

/// Cut where the path comes back over a half-edge.
void LoopFiller::reduce()
{
    size_t kept = 0;
    for (size_t i = 0; i < count_; ++i)
        if (kept > 0 && crossings_[kept - 1].entering == crossings_[i].leaving)
            addChord(crossings_[--kept], 1 - crossings_[i].t);
        else
            crossings_[kept++] = crossings_[i];
    // also where the path's end meets its beginning
    size_t first = 0;
    for (; kept > first + 1 && crossings_[kept - 1].entering == crossings_[first].leaving; ++first)
        addChord(crossings_[--kept], 1 - crossings_[first].t);
    std::copy(crossings_.begin() + static_cast<ptrdiff_t>(first),
              crossings_.begin() + static_cast<ptrdiff_t>(kept), crossings_.begin());
    count_ = kept - first;
}

/// Finish a path that goes once around a single corner.
bool LoopFiller::closeRing()
{
    const bool left = turnsLeft(0);
    for (size_t i = 0; i < count_; ++i)
    {
        const HalfEdgeId entering = crossings_[i].entering;
        const HalfEdgeId next = crossings_[(i + 1) % count_].leaving;
        if (next != (left ? previousHalfEdge(entering) : nextHalfEdge(entering)) ||
            (i > 0 && cornerTriangle(entering) == cornerTriangle(crossings_[0].entering)))
            return false;
    }
    inner_.push_back(cornerAt(crossings_[0], left));
    for (size_t i = 0; i < count_; ++i)
        addChord(crossings_[i], left ? 1.0f : 0.0f);
    count_ = 0;
    return true;
}

/// Push the path over a corner that it mostly goes around, so that it becomes shorter.
bool LoopFiller::pushOver()
{
    for (size_t start = 0; start < count_; ++start)
    {
        const bool left = turnsLeft(start);
        if (turnsLeft(start == 0 ? count_ - 1 : start - 1) == left)
            continue;
        size_t run = 1;
        while (run < count_ && turnsLeft((start + run) % count_) == left)
            ++run;
        if (run + 1 > count_)
            continue;
        // half-edges to cross when going around the corner the other way
        const TriangleId goal = cornerTriangle(crossings_[(start + run) % count_].entering);
        std::array<HalfEdgeId, kMaxCrossings> half_edges;
        size_t found = 0;
        const HalfEdgeId behind = crossings_[start].leaving;
        HalfEdgeId at = left ? nextHalfEdge(behind) : behind; // starts at the corner
        while (cornerTriangle(at) != goal && found < run)
        {
            const HalfEdgeId half_edge = left ? at : previousHalfEdge(at);
            if (opposites_[half_edge] == kInvalid)
                break;
            half_edges[found++] = half_edge;
            at = left ? nextHalfEdge(opposites_[half_edge]) : opposites_[half_edge];
        }
        if (cornerTriangle(at) != goal)
            continue;
        std::rotate(crossings_.begin(), crossings_.begin() + static_cast<ptrdiff_t>(start),
                    crossings_.begin() + static_cast<ptrdiff_t>(count_));
        replaceRun(run, left, {half_edges.data(), found});
        return true;
    }
    return false;
}

/// Replace the first `run` + 1 crossings, between which the path turns left or right around one corner, by
/// crossings of the given half-edges at that corner.
void LoopFiller::replaceRun(size_t run, bool left, std::span<const HalfEdgeId> half_edges)
{
    inner_.push_back(cornerAt(crossings_[0], left));
    for (size_t i = 0; i <= run; ++i)
        addChord(crossings_[i], left ? 1.0f : 0.0f);
    for (size_t i = 0; i < half_edges.size(); ++i)
        crossings_[i] = {half_edges[i], opposites_[half_edges[i]], left ? 0.0f : 1.0f};
    const auto rest = crossings_.begin() + static_cast<ptrdiff_t>(run) + 1;
    std::copy(rest, crossings_.begin() + static_cast<ptrdiff_t>(count_),
              crossings_.begin() + static_cast<ptrdiff_t>(half_edges.size()));
    count_ -= run + 1 - half_edges.size();
    reduce();
}

} // namespace hearth::clusters
