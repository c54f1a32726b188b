// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/rules/families.h"

#include <algorithm>

namespace hearth::texels
{

namespace
{

struct Family
{
    std::string_view name;
    bool Families::*member;
};

constexpr Family kFamilies[] = {{"astc", &Families::astc},
                                {"astc-hdr", &Families::astc_hdr},
                                {"etc2", &Families::etc2},
                                {"bc", &Families::bc}};

constexpr std::string_view kEffortNames[] = {"draft", "normal", "high"};

} // namespace

std::vector<std::string> familyNames()
{
    std::vector<std::string> names;
    for (const Family& family : kFamilies)
        names.emplace_back(family.name);
    return names;
}

bool addFamily(std::string_view name, Families& families)
{
    const Family* const found = std::ranges::find(kFamilies, name, &Family::name);
    if (found == std::end(kFamilies))
        return false;
    families.*found->member = true;
    return true;
}

std::string familiesText(const Families& families)
{
    std::string text;
    for (const Family& family : kFamilies)
        if (families.*family.member)
            text += (text.empty() ? "" : ", ") + std::string(family.name);
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
