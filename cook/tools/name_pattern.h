// Matches names against patterns of rules.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <string_view>

namespace hearth::tools
{

/// True if all of `text` matches: * stands for any characters, ? for one, everything else for itself.
bool matchesPattern(std::string_view pattern, std::string_view text);

} // namespace hearth::tools
