// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/shell/name_list.h"

#include <algorithm>

namespace hearth::command
{

std::string namesText(const std::vector<std::string>& names)
{
    constexpr size_t kMaxNamed = 3;
    // "and 1 more" is no shorter than the name
    const size_t named = names.size() <= kMaxNamed + 1 ? names.size() : kMaxNamed;
    std::string text;
    for (size_t i = 0; i < named; ++i)
        text += (i == 0 ? "" : ", ") + names[i];
    if (named < names.size())
        text += " and " + std::to_string(names.size() - named) + " more";
    return text;
}

} // namespace hearth::command
