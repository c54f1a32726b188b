// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/profiles/glob.h"

#include "cook/tools/name_pattern.h"

#include <vector>

namespace hearth::profiles
{

namespace
{

std::vector<std::string_view> splitNames(std::string_view path)
{
    std::vector<std::string_view> names;
    for (size_t at = 0; at <= path.size();)
    {
        const size_t end = std::min(path.find('/', at), path.size());
        names.push_back(path.substr(at, end - at));
        at = end + 1;
    }
    return names;
}

} // namespace

bool matchesPath(std::string_view pattern, std::string_view path)
{
    const std::vector<std::string_view> pattern_names = splitNames(pattern);
    const std::vector<std::string_view> names = splitNames(path);
    // after a mismatch, the last ** takes one folder more; earlier ones need not be tried again
    size_t w = 0;
    size_t n = 0;
    size_t any = std::string_view::npos;
    size_t any_end = 0;
    while (n < names.size())
    {
        if (w < pattern_names.size() && pattern_names[w] == "**")
        {
            any = w++;
            any_end = n;
        }
        else if (w < pattern_names.size() && tools::matchesPattern(pattern_names[w], names[n]))
        {
            ++w;
            ++n;
        }
        else if (any != std::string_view::npos)
        {
            w = any + 1;
            n = ++any_end;
        }
        else
            return false;
    }
    while (w < pattern_names.size() && pattern_names[w] == "**")
        ++w;
    return w == pattern_names.size();
}

bool isPattern(std::string_view text)
{
    return text.find_first_of("*?") != std::string_view::npos;
}

} // namespace hearth::profiles
