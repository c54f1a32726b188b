// Text of a cache entry: its fields after a line with their checksum.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/cache/fields.h"

namespace hearth::cache
{

/// Serialize an entry. First line: "hearth.entry/1", a blank, SHA-256 of the rest.
std::string formatEntry(const Fields& fields);

/// Parse an entry; nullopt where the text is torn or damaged.
std::optional<Fields> parseEntry(std::string_view text);

} // namespace hearth::cache
