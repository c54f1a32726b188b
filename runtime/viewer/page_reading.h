// Page reads for streaming.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

namespace hearth::viewer
{

/// Decode a page into `destination`, whose size is the page's; on any thread. Returns false and prints a
/// warning on stderr if the page cannot be read or contradicts its pack (pack::Pack); the clusters that it
/// refines stay coarse.
bool readPage(const formats::PackView& pack, uint32_t page, std::span<std::byte> destination);

} // namespace hearth::viewer
