// Lines of text.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <span>
#include <string>

namespace hearth::tools
{

/// Each line with its end.
inline std::string joinedLines(std::span<const std::string> lines)
{
    std::string text;
    for (const std::string& line : lines)
        text += line + '\n';
    return text;
}

} // namespace hearth::tools
