// Reads text files as strings and lines.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <string>
#include <vector>

namespace hearth::corpus
{

/// Return the first `max_size` bytes of a file; empty if it cannot be read.
std::string readText(const std::string& path, size_t max_size);

/// True for control characters of terminals, except line ends and tabs.
bool isControlCharacter(char c);

std::vector<std::string> splitLines(const std::string& text);

} // namespace hearth::corpus
