// Priority queue of pages that may be evicted, by worth: a binary heap with an index of positions.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/assert.h"
#include "formats/base/index.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace hearth::pack
{

/// Eviction order: lowest worth first; of equal worth the largest page number, which is the finest page,
/// first. insert, erase and update take O(log n); nothing allocates after construction.
class EvictionQueue
{
public:
    explicit EvictionQueue(uint32_t page_count)
        : heap_index_(page_count, kInvalidIndex), worth_(page_count, 0)
    {
        heap_.reserve(page_count);
    }

    bool empty() const { return heap_.empty(); }
    bool contains(uint32_t page) const { return heap_index_[page] != kInvalidIndex; }
    /// Return the page to evict first, or its worth. Precondition: the queue is not empty.
    uint32_t front() const { return heap_.front(); }
    uint64_t frontWorth() const { return worth_[heap_.front()]; }

    /// Precondition: the page is not in the queue.
    void insert(uint32_t page, uint64_t worth)
    {
        HEARTH_RUNTIME_ASSERT(!contains(page));
        worth_[page] = worth;
        heap_index_[page] = static_cast<uint32_t>(heap_.size());
        heap_.push_back(page);
        siftUp(heap_index_[page]);
    }

    /// Precondition: the page is in the queue.
    void erase(uint32_t page)
    {
        HEARTH_RUNTIME_ASSERT(contains(page));
        const uint32_t index = heap_index_[page];
        const uint32_t last = heap_.back();
        heap_.pop_back();
        heap_index_[page] = kInvalidIndex;
        if (last == page)
            return;
        setAt(last, index);
        restoreHeap(index);
    }

    /// Precondition: the page is in the queue.
    void update(uint32_t page, uint64_t worth)
    {
        HEARTH_RUNTIME_ASSERT(contains(page));
        worth_[page] = worth;
        restoreHeap(heap_index_[page]);
    }

private:
    bool before(uint32_t a, uint32_t b) const
    {
        return worth_[a] != worth_[b] ? worth_[a] < worth_[b] : a > b;
    }

    void setAt(uint32_t page, uint32_t index)
    {
        heap_[index] = page;
        heap_index_[page] = index;
    }

    void restoreHeap(uint32_t index)
    {
        const uint32_t page = heap_[index];
        siftUp(index);
        siftDown(heap_index_[page]);
    }

    void siftUp(uint32_t index)
    {
        const uint32_t page = heap_[index];
        for (; index > 0 && before(page, heap_[(index - 1) / 2]); index = (index - 1) / 2)
            setAt(heap_[(index - 1) / 2], index);
        setAt(page, index);
    }

    void siftDown(uint32_t index)
    {
        const uint32_t page = heap_[index];
        for (uint32_t child = 2 * index + 1; child < heap_.size(); child = 2 * index + 1)
        {
            if (child + 1 < heap_.size() && before(heap_[child + 1], heap_[child]))
                ++child;
            if (!before(heap_[child], page))
                break;
            setAt(heap_[child], index);
            index = child;
        }
        setAt(page, index);
    }

    std::vector<uint32_t> heap_;
    std::vector<uint32_t> heap_index_; ///< for each page its index in heap_, or kInvalidIndex
    std::vector<uint64_t> worth_;      ///< for each page its worth
};

} // namespace hearth::pack
