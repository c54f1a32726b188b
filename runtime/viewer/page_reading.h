// Pages of a pack for a stream.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

namespace hearth::viewer
{

/// Decode a page into `destination`, whose size is the page's; on any thread. False where it cannot be read or is not what its
/// pack promises (pack::Pack), which is told on stderr: what it refines stays coarse.
bool readPage(const formats::PackView& pack, uint32_t page, std::span<std::byte> destination);

} // namespace hearth::viewer
