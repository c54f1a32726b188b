// Slots of staging memory: each is taken for a read, and free again once the frame that copies it has
// completed.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/assert.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace hearth::pack
{

class StagingSlots
{
public:
    /// All slots are free, the first is taken next.
    explicit StagingSlots(uint32_t count) : free_(count)
    {
        std::iota(free_.rbegin(), free_.rend(), 0u);
        copying_.reserve(count);
    }

    bool isEmpty() const { return free_.empty(); }

    /// Take a slot; there is one (asserted).
    uint32_t take()
    {
        HEARTH_ASSERT(!free_.empty());
        const uint32_t slot = free_.back();
        free_.pop_back();
        return slot;
    }

    /// Give a slot back that no frame copies.
    void giveBack(uint32_t slot) { free_.push_back(slot); }

    /// Give a slot back that a frame copies, in the order of the frames.
    void giveBackAfter(uint32_t slot, uint64_t serial) { copying_.push_back({slot, serial}); }

    /// Free the slots that frames up to this one copy: they have completed.
    void complete(uint64_t serial)
    {
        const auto end = std::find_if(copying_.begin(), copying_.end(),
                                      [&](const Copying& copying) { return copying.serial > serial; });
        for (auto copying = copying_.begin(); copying != end; ++copying)
            free_.push_back(copying->slot);
        copying_.erase(copying_.begin(), end);
    }

private:
    struct Copying
    {
        uint32_t slot;
        uint64_t serial;
    };

    std::vector<uint32_t> free_;
    std::vector<Copying> copying_; ///< ordered by serial
};

} // namespace hearth::pack
