// An entry of the cache as a file: its fields under a line that vouches for them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/cache/fields.h"

namespace hearth::cache
{

/// First line: "hearth.entry/1", a blank, SHA-256 of the rest.
std::string entryText(const Fields& fields);

/// nullopt where the text is torn or damaged
std::optional<Fields> entryFields(std::string_view text);

} // namespace hearth::cache
