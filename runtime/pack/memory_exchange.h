// Moves memory between pages of geometry and mips of textures, within one budget. Plain numbers: no
// reading, no device, no clock. See runtime/pack/README.md, "One budget".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/pack/memory_balance.h"
#include "runtime/pack/page_graph.h"

#include <optional>
#include <span>
#include <vector>

namespace hearth::pack
{

/// Pool of pages whose memory may move: fixed slots, and parts of the pool with memory of their own.
struct ExchangeLayout
{
    uint64_t budget_bytes = 0;
    uint64_t pinned_page_bytes = 0;    ///< of the pool
    uint64_t pinned_texture_bytes = 0; ///< of the tails
    uint32_t slot_bytes = 0;
    uint32_t fixed_slots = 0;   ///< that geometry never gives
    uint32_t granule_slots = 0; ///< >= 1
    uint32_t granules = 0;      ///< that move
    uint32_t start_granules = 0;
    uint32_t parts = 0;      ///< movable parts of the pool
    uint32_t part_slots = 0; ///< maximum of each; all of them hold all granules

    /// Return the bytes of textures while geometry has its fixed slots alone.
    uint64_t maxTextureBytes() const
    {
        return budget_bytes - pinned_page_bytes - uint64_t{fixed_slots} * slot_bytes;
    }
};

/// Parts of the pool that can be made.
struct PoolParts
{
    uint32_t count = 0;
    uint32_t max_slots = 0; ///< of each
};

/// Plan the exchange: at first as divideMemory divides. Each side keeps an eighth of what is not always
/// resident, or all that it can use. None if the budget holds everything, or if there is nothing to
/// move.
/// pages     with the sizes of their slots (PageGraph::withSlotSize)
/// textures  TextureGraph::nodes
std::optional<ExchangeLayout> planExchange(uint64_t budget_bytes, const PageGraph& pages, uint32_t slot_bytes,
                                           const PageGraph& textures, const PoolParts& parts);

/// Exchange of one scene. Once update() begins a move,
///     isClosing(part)     the caller closes the part (PageStream::closePart) and frees its memory: closed()
///     nextPart(in use)    it gives the part memory and opens it: opened()
/// and textures fit textureBytes() all the time. The bytes of the pool and those that textures use
/// never exceed the budget together, in whatever order and however late this happens.
class MemoryExchange
{
public:
    explicit MemoryExchange(const ExchangeLayout& layout);

    /// Take the demands of a round; during a move they are ignored. Returns true if a move begins.
    bool update(const MemoryDemand& geometry, const MemoryDemand& textures);

    bool isMoving() const { return is_moving_; }
    bool atRest() const { return !is_moving_ && balance_.atRest(); }

    /// Movable parts are 0 .. layout().parts - 1.
    uint32_t slots(uint32_t part) const { return held_[part]; } ///< that have memory
    bool isClosing(uint32_t part) const { return is_closing_[part]; }
    void closed(uint32_t part); ///< isClosing (asserted)

    /// Part to be given memory.
    struct Opening
    {
        uint32_t part = 0;
        uint32_t slots = 0;
    };
    /// Return a part that has room in the budget now, if any. Ends a move that has nothing left to do.
    std::optional<Opening> nextPart(uint64_t texture_bytes_in_use);
    void opened(const Opening& opening);
    /// The device has no memory for the part: the move ends without it, and geometry gets no more
    /// again.
    void failed();

    /// Slots that the error scale of geometry fits: the smaller share during a move.
    uint32_t demandSlots() const;
    /// Budget of textures: what neither the pool has nor the move will give it.
    uint64_t textureBytes() const;
    const ExchangeLayout& layout() const { return layout_; }

private:
    uint32_t heldSlots() const; ///< in movable parts
    uint64_t poolBytes(uint64_t moving_slots) const;
    void plan(uint32_t slots);

    ExchangeLayout layout_;
    MemoryBalance balance_;
    std::vector<uint32_t> held_;    ///< [part] slots
    std::vector<bool> is_closing_;  ///< [part]
    std::vector<uint32_t> opening_; ///< [part] slots to be opened
    uint32_t moving_slots_ = 0;     ///< of movable parts after the move
    uint32_t slots_before_ = 0;     ///< and before
    bool is_moving_ = false;
};

} // namespace hearth::pack
