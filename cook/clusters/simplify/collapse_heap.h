// Priority queue of collapses, cheapest first.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/index_types.h"
#include "formats/base/assert.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hearth::clusters
{

/// Collapse of one position to another.
class HeapEntry
{
public:
    /// cost     at least 0; NaN is dearer than any
    /// version  counted by the caller
    HeapEntry(float cost, PositionId position, PositionId target, uint32_t version)
        : // + 0.0: no negative zero
          order_(uint64_t{std::bit_cast<uint32_t>(cost + 0.0f)} << 32 | toIndex(position)),
          target_(target),
          version_(version)
    {
        HEARTH_RUNTIME_ASSERT(!(cost < 0));
    }

    float cost() const { return std::bit_cast<float>(static_cast<uint32_t>(order_ >> 32)); }
    PositionId position() const { return PositionId{static_cast<uint32_t>(order_)}; }
    PositionId target() const { return target_; }
    uint32_t version() const { return version_; }

    /// Compare by cost, then by position.
    bool operator<(const HeapEntry& b) const { return order_ < b.order_; }

private:
    uint64_t order_; ///< non-negative floats are ordered as their bits
    PositionId target_;
    uint32_t version_;
};

/// Binary heap. Selects the cheaper of two children by counting, not by a branch, which would be
/// unpredictable: that is where the heaps of the standard library spend their time.
class CollapseHeap
{
public:
    bool empty() const { return entries_.empty(); }
    const HeapEntry& front() const { return entries_.front(); }
    void clear() { entries_.clear(); }

    void push(const HeapEntry& entry)
    {
        entries_.push_back(entry);
        rise(entries_.size() - 1, entry);
    }

    HeapEntry pop()
    {
        HEARTH_RUNTIME_ASSERT(!empty());
        const HeapEntry cheapest = entries_.front();
        const HeapEntry last = entries_.back();
        entries_.pop_back();
        const size_t count = entries_.size();
        if (count == 0)
            return cheapest;
        // the hole sinks to the bottom, from where the last entry rarely rises
        size_t hole = 0;
        for (size_t child = 1; child + 1 < count; child = hole * 2 + 1)
        {
            child += entries_[child + 1] < entries_[child] ? 1u : 0u;
            entries_[hole] = entries_[child];
            hole = child;
        }
        if (hole * 2 + 1 < count)
        {
            entries_[hole] = entries_[hole * 2 + 1];
            hole = hole * 2 + 1;
        }
        rise(hole, last);
        return cheapest;
    }

private:
    /// Insert an entry on the path from a hole to the front.
    void rise(size_t hole, const HeapEntry& entry)
    {
        for (size_t parent; hole > 0 && entry < entries_[parent = (hole - 1) / 2]; hole = parent)
            entries_[hole] = entries_[parent];
        entries_[hole] = entry;
    }

    std::vector<HeapEntry> entries_;
};

} // namespace hearth::clusters
