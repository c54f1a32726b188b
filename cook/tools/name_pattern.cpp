// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/tools/name_pattern.h"

#include <cstddef>

namespace hearth::tools
{

bool matchesPattern(std::string_view pattern, std::string_view text)
{
    // after a mismatch, the last * takes one character more: earlier ones need no retry
    size_t p = 0;
    size_t t = 0;
    size_t star = std::string_view::npos;
    size_t star_end = 0;
    while (t < text.size())
    {
        if (p < pattern.size() && pattern[p] == '*')
        {
            star = p++;
            star_end = t;
        }
        else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == text[t]))
        {
            ++p;
            ++t;
        }
        else if (star != std::string_view::npos)
        {
            p = star + 1;
            t = ++star_end;
        }
        else
            return false;
    }
    return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

} // namespace hearth::tools
