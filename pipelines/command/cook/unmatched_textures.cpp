// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/cook/unmatched_textures.h"

#include "cook/json/json.h"
#include "cook/tools/name_pattern.h"
#include "formats/base/nearest_match.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <tuple>

namespace hearth::command
{

namespace
{

/// List of rules: its setting, and the member that says which textures a rule is for.
struct RuleList
{
    std::string_view key;
    const char* member;
};

constexpr RuleList kByRole{"textures.role", "role"};
constexpr RuleList kByName{"textures.image", "name"};

/// Place of a rule, where it was set and its number there, and its pattern or role.
using RuleKey = std::tuple<std::string, size_t, std::string>;

/// Return a member of the textures of a source; nullopt where they are not known.
std::optional<std::vector<std::string>> readMembers(const std::optional<std::string>& statistics,
                                                    const char* member)
{
    const Json json = Json::parse(statistics.value_or("")).value_or(Json());
    if (!json.is_object() || !json.contains("images"))
        return std::nullopt;
    std::vector<std::string> texts;
    for (const Json& image : json["images"])
        texts.push_back(image.value(member, ""));
    return texts;
}

/// Return the text of a warning that helps to mend a rule: the nearest name, or all roles.
std::string describeOthers(const RuleList& list, const std::string& text, std::vector<std::string> others)
{
    if (list.key == kByName.key)
    {
        const std::string nearest = nearestMatch(text, others);
        return nearest.empty() ? "" : fmt::format("; nearest: {}", nearest);
    }
    std::ranges::sort(others);
    others.erase(std::unique(others.begin(), others.end()), others.end());
    return others.empty() ? "" : fmt::format("; there are {}", fmt::join(others, ", "));
}

Error makeWarning(const RuleList& list, const RuleKey& rule, const std::vector<std::string>& others)
{
    const auto& [origin, index, text] = rule;
    return {Issue::texture_unmatched, origin, fmt::format("{}[{}]", list.key, index),
            fmt::format("'{}' matches no texture of {}{}", text, others.size(),
                        describeOthers(list, text, others))};
}

/// Add a warning for each rule of a list that matches nothing.
void addUnmatched(const RuleList& list, const graph::CookSettings& settings,
                  const std::vector<std::optional<std::string>>& statistics, std::vector<Error>& warnings)
{
    std::map<RuleKey, bool> is_matched;
    std::vector<std::string> others;
    for (size_t source = 0; source < settings.values_of_source.size(); ++source)
    {
        const settings::Value* value = settings::findValue(settings.values_of_source[source], list.key);
        if (value == nullptr)
            continue;
        const auto texts = readMembers(statistics[source], list.member);
        const Json rules = settings::toJson(*value);
        for (size_t i = 0; i < rules.size(); ++i)
        {
            const size_t number = value->rule_numbers.empty() ? i : value->rule_numbers[i];
            const auto pattern = rules[i].value(list.member, "");
            const bool matches =
                !texts || std::ranges::any_of(*texts, [&](const std::string& text)
                                              { return tools::matchesPattern(pattern, text); });
            bool& is_known = is_matched[{value->origin, number, pattern}];
            is_known = is_known || matches;
        }
        if (texts)
            others.insert(others.end(), texts->begin(), texts->end());
    }
    for (const auto& [rule, matched] : is_matched)
        if (!matched)
            warnings.push_back(makeWarning(list, rule, others));
}

} // namespace

std::vector<Error> findUnmatchedTextures(const graph::CookSettings& settings,
                                         const std::vector<std::optional<std::string>>& statistics)
{
    std::vector<Error> warnings;
    for (const RuleList& list : {kByRole, kByName})
        addUnmatched(list, settings, statistics, warnings);
    return warnings;
}

} // namespace hearth::command
