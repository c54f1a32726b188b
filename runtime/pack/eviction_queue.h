// Priority queue of pages that may be evicted, by worth: a binary heap with an index of positions.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/assert.h"

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
    explicit EvictionQueue(uint32_t page_count) : place_(page_count, kNowhere), worth_(page_count, 0)
    {
        heap_.reserve(page_count);
    }

    bool empty() const { return heap_.empty(); }
    bool contains(uint32_t page) const { return place_[page] != kNowhere; }
    /// Return the page to evict first, or its worth. Precondition: the queue is not empty.
    uint32_t least() const { return heap_.front(); }
    uint64_t leastWorth() const { return worth_[heap_.front()]; }

    /// Precondition: the page is not in the queue.
    void insert(uint32_t page, uint64_t worth)
    {
        HEARTH_RUNTIME_ASSERT(!contains(page));
        worth_[page] = worth;
        place_[page] = static_cast<uint32_t>(heap_.size());
        heap_.push_back(page);
        rise(place_[page]);
    }

    /// Precondition: the page is in the queue.
    void erase(uint32_t page)
    {
        HEARTH_RUNTIME_ASSERT(contains(page));
        const uint32_t place = place_[page];
        const uint32_t last = heap_.back();
        heap_.pop_back();
        place_[page] = kNowhere;
        if (last == page)
            return;
        put(last, place);
        settle(place);
    }

    /// Precondition: the page is in the queue.
    void update(uint32_t page, uint64_t worth)
    {
        HEARTH_RUNTIME_ASSERT(contains(page));
        worth_[page] = worth;
        settle(place_[page]);
    }

private:
    static constexpr uint32_t kNowhere = std::numeric_limits<uint32_t>::max();

    bool before(uint32_t a, uint32_t b) const
    {
        return worth_[a] != worth_[b] ? worth_[a] < worth_[b] : a > b;
    }

    void put(uint32_t page, uint32_t place)
    {
        heap_[place] = page;
        place_[page] = place;
    }

    void settle(uint32_t place)
    {
        const uint32_t page = heap_[place];
        rise(place);
        sink(place_[page]);
    }

    void rise(uint32_t place)
    {
        const uint32_t page = heap_[place];
        for (; place > 0 && before(page, heap_[(place - 1) / 2]); place = (place - 1) / 2)
            put(heap_[(place - 1) / 2], place);
        put(page, place);
    }

    void sink(uint32_t place)
    {
        const uint32_t page = heap_[place];
        for (uint32_t child = 2 * place + 1; child < heap_.size(); child = 2 * place + 1)
        {
            if (child + 1 < heap_.size() && before(heap_[child + 1], heap_[child]))
                ++child;
            if (!before(heap_[child], page))
                break;
            put(heap_[child], place);
            place = child;
        }
        put(page, place);
    }

    std::vector<uint32_t> heap_;
    std::vector<uint32_t> place_; ///< for each page its index in heap_, or kNowhere
    std::vector<uint64_t> worth_; ///< for each page its worth
};

} // namespace hearth::pack
