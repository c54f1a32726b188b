// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/rules/families.h"

#include <algorithm>

namespace hearth::texels
{

namespace
{

constexpr std::string_view kEffortNames[] = {"draft", "normal", "high"};

} // namespace

bool addFamily(std::string_view name, Families& families)
{
    if (name == "astc")
        families.astc = true;
    else if (name == "etc2")
        families.etc2 = true;
    else if (name == "bc")
        families.bc = true;
    else
        return false;
    return true;
}

std::string familiesText(const Families& families)
{
    std::string text;
    const auto add = [&](bool has, const char* name)
    {
        if (has)
            text += (text.empty() ? "" : ", ") + std::string(name);
    };
    add(families.astc, "astc");
    add(families.etc2, "etc2");
    add(families.bc, "bc");
    return text.empty() ? "none" : text;
}

std::span<const std::string_view> effortNames()
{
    return kEffortNames;
}

std::optional<Effort> parseEffort(std::string_view name)
{
    const auto* const found = std::ranges::find(kEffortNames, name);
    if (found == std::end(kEffortNames))
        return std::nullopt;
    return static_cast<Effort>(found - std::begin(kEffortNames));
}

} // namespace hearth::texels
