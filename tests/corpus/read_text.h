// Text files as strings and lines.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <string>
#include <vector>

namespace hearth::corpus
{

/// The first `max_size` bytes of a file; empty where it cannot be read.
std::string readText(const std::string& path, size_t max_size);

/// Characters that do something to a terminal; the ends of lines and tabs are none.
bool isControlCharacter(char c);

std::vector<std::string> linesOf(const std::string& text);

} // namespace hearth::corpus
