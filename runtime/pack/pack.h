// A pack in memory: mapped, checked once, then trusted. No Vulkan. See README.md.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack_view.h"

#include <span>
#include <string>

namespace hearth::pack
{

/// A pack whose container and meaning have been checked: every range, index, value and bound that FORMAT.md promises
/// holds, and code that reads it does not look again. Spans, names and texels that it hands out hold as long as it
/// lives. Reading is const and may be done from any number of threads.
class Pack
{
public:
    /// Map the file and check all of it. Time: one pass over the file and the decoded pages.
    /// errors: input_missing, read_failed, container_*, chunk_*, page_hash, meaning_*.
    static Result<Pack> open(const std::string& path);

    /// The same on bytes in memory, 64-byte aligned, that outlive the pack. `name` stands in messages.
    static Result<Pack> fromBytes(std::span<const std::byte> bytes, std::string name);

    const std::string& name() const { return view_.name(); }

    /// All tables.
    const formats::PackView& view() const { return view_; }
    const formats::PackView* operator->() const { return &view_; }

    /// Bytes of a page after decoding: what `out` of readPage must hold. `page` is in the page table.
    uint32_t pageSize(uint32_t page) const { return view_.pages()[page].size; }

    /// Decode a page into the front of `out`, which may be larger, and return that part; allocates nothing.
    /// errors: page_hash and chunk_codec where the file changed under the mapping.
    Result<std::span<const std::byte>> readPage(uint32_t page, std::span<std::byte> out) const;

private:
    explicit Pack(formats::PackView view) : view_(std::move(view)) {}
    static Result<Pack> check(formats::ContainerReader reader);

    formats::PackView view_;
};

} // namespace hearth::pack
