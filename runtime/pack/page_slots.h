// Slots of the geometry pool, in parts: a fixed one, and parts whose memory comes and goes as a whole.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/assert.h"

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace hearth::pack
{

/// Part 0 has the first slots and is always open. Part p >= 1 has the slots from `fixed_slots + (p - 1)
/// * part_slots` on, at most `part_slots`, and is closed at first.
class PageSlots
{
public:
    PageSlots(uint32_t fixed_slots, uint32_t movable_parts, uint32_t part_slots)
        : fixed_slots_(fixed_slots), part_slots_(part_slots), parts_(1 + size_t{movable_parts})
    {
        fill(0, fixed_slots);
    }

    uint32_t part(uint32_t slot) const
    {
        return slot < fixed_slots_ ? 0 : 1 + (slot - fixed_slots_) / part_slots_;
    }

    /// Open the first `count` slots of a part that is closed and has no slot in use (asserted).
    void open(uint32_t part, uint32_t count)
    {
        HEARTH_ASSERT(part > 0 && count <= part_slots_ && usedSlots(part) == 0 && !parts_[part].is_open);
        fill(part, count);
    }

    /// Close a part: its free slots are no longer taken, and those in use are given back to nobody.
    void close(uint32_t part)
    {
        HEARTH_ASSERT(part > 0 && parts_[part].is_open);
        open_slots_ -= parts_[part].count;
        parts_[part].is_open = false;
        parts_[part].free.clear();
    }

    bool isOpen(uint32_t part) const { return parts_[part].is_open; }
    uint32_t usedSlots(uint32_t part) const { return parts_[part].used; }
    uint32_t openSlots() const { return open_slots_; } ///< free or in use

    /// Take a slot of the first open part that has a free one; there is one (asserted).
    uint32_t take()
    {
        for (Part& part : parts_)
            if (!part.free.empty())
            {
                const uint32_t slot = part.free.back();
                part.free.pop_back();
                ++part.used;
                return slot;
            }
        HEARTH_ASSERT(false);
        return 0;
    }

    void giveBack(uint32_t slot)
    {
        Part& owner = parts_[part(slot)];
        HEARTH_ASSERT(owner.used > 0);
        --owner.used;
        if (owner.is_open)
            owner.free.push_back(slot);
    }

private:
    struct Part
    {
        std::vector<uint32_t> free; ///< a stack, at first with the first slot on top
        uint32_t count = 0, used = 0;
        bool is_open = false;
    };

    void fill(uint32_t part, uint32_t count)
    {
        parts_[part].free.resize(count);
        const uint32_t first = part == 0 ? 0 : fixed_slots_ + (part - 1) * part_slots_;
        std::iota(parts_[part].free.rbegin(), parts_[part].free.rend(), first);
        parts_[part].count = count;
        parts_[part].is_open = true;
        open_slots_ += count;
    }

    uint32_t fixed_slots_, part_slots_;
    uint32_t open_slots_ = 0;
    std::vector<Part> parts_;
};

} // namespace hearth::pack
