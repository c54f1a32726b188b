// Memory-mapped pack: tables are checked once at opening, pages when they are read. Independent of Vulkan.
// See runtime/pack/README.md.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <span>
#include <string>

namespace hearth::pack
{

/// Memory-mapped pack that returns checked data only: every range, index, value and bound that
/// formats/FORMAT.md promises holds, so callers need not check again. Tables are checked when the pack is
/// opened; pages and texels when they are read, so reading can fail. Spans, names and texels stay valid as
/// long as the pack lives. Reading is const and thread-safe.
class Pack
{
public:
    /// Map the file and check its structure and all tables; no byte of pages and texels is read. Time: linear
    /// in the size of the tables.
    /// errors: input_missing, read_failed, container_*, chunk_*, meaning_*.
    static Result<Pack> open(const std::string& path);

    /// Open a pack in memory that is 64-byte aligned and outlives the pack. `name` is used in messages.
    static Result<Pack> fromBytes(std::span<const std::byte> bytes, std::string name);

    /// Check the whole file at once, as `hearth verify` does; after success, reads fail only if the file
    /// changes. Time: one pass over the file and the decoded pages, on one core. May run beside other reads.
    /// errors: container_padding, chunk_hash, chunk_codec, page_hash, meaning_*.
    Status checkAll() const;

    const std::string& name() const { return view_.name(); }

    /// Return the view of all tables; its pages are checked when they are decoded.
    const formats::PackView& view() const { return view_; }
    const formats::PackView* operator->() const { return &view_; }

    /// Return the number of what can be streamed: the pages of geometry, and after them the pieces of
    /// textures.
    uint32_t pageCount() const
    {
        return static_cast<uint32_t>(view_.pages().size() + view_.texturePieces().size());
    }

    /// Return the decoded size of a page in bytes, the minimum size of `out` of readPage.
    /// page  below pageCount()
    uint32_t pageSize(uint32_t page) const;

    /// Decode a page into the front of `out`, which may be larger, check it, and return that part. Allocates
    /// only some memory on the first call of a thread. A page of geometry leaves `out` unchanged on error.
    /// errors: page_hash, chunk_codec, meaning_*.
    Result<std::span<const std::byte>> readPage(uint32_t page, std::span<std::byte> out) const;

private:
    explicit Pack(formats::PackView view) : view_(std::move(view)) {}
    static Result<Pack> check(formats::ContainerReader reader);

    formats::PackView view_;
};

} // namespace hearth::pack
