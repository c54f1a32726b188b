// A pack in memory: mapped, its tables checked once, its pages as they are read, then trusted. No Vulkan. See README.md.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <span>
#include <string>

namespace hearth::pack
{

/// A pack of which nothing is handed out that has not been checked: every range, index, value and bound that FORMAT.md
/// promises holds, and code that reads it does not look again. Tables are checked when it is opened; pages and texels when
/// they are read, which can fail therefore. Spans, names and texels that it hands out hold as long as it lives. Reading is
/// const and may be done from any number of threads.
class Pack
{
public:
    /// Map the file and check its structure and all tables. Of pages and texels no byte is read. Time: linear in the tables.
    /// errors: input_missing, read_failed, container_*, chunk_*, meaning_*.
    static Result<Pack> open(const std::string& path);

    /// The same on bytes in memory, 64-byte aligned, that outlive the pack. `name` stands in messages.
    static Result<Pack> fromBytes(std::span<const std::byte> bytes, std::string name);

    /// Check the whole file at once, as `hearth verify` does: where it is right, reads fail only if the file changes. Time: one
    /// pass over the file and the decoded pages, on one core; may be done beside other reads.
    /// errors: container_padding, chunk_hash, chunk_codec, page_hash, meaning_*.
    Status checkAll() const;

    const std::string& name() const { return view_.name(); }

    /// All tables, and pages that are checked when they are decoded.
    const formats::PackView& view() const { return view_; }
    const formats::PackView* operator->() const { return &view_; }

    /// Bytes of a page after decoding: what `out` of readPage must hold. `page` is in the page table.
    uint32_t pageSize(uint32_t page) const { return view_.pages()[page].size; }

    /// Decode a page into the front of `out`, which may be larger, check it, and return that part; allocates nothing but some
    /// memory on the first call of a thread. `out` is left alone where there is an error.
    /// errors: page_hash, chunk_codec, meaning_*.
    Result<std::span<const std::byte>> readPage(uint32_t page, std::span<std::byte> out) const;

private:
    explicit Pack(formats::PackView view) : view_(std::move(view)) {}
    static Result<Pack> check(formats::ContainerReader reader);

    formats::PackView view_;
};

} // namespace hearth::pack
