// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/cook/unmatched_textures.h"

#include "cook/json/json.h"
#include "cook/tools/name_pattern.h"
#include "formats/base/nearest_match.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <tuple>

namespace hearth::command
{

namespace
{

constexpr const char* kRules = "textures.image";

/// Place of a rule, where it was set and its number there, and its pattern.
using RuleKey = std::tuple<std::string, size_t, std::string>;

/// Return the names of the textures of a source; nullopt where they are not known.
std::optional<std::vector<std::string>> readNames(const std::optional<std::string>& statistics)
{
    const Json json = Json::parse(statistics.value_or("")).value_or(Json());
    if (!json.is_object() || !json.contains("images"))
        return std::nullopt;
    std::vector<std::string> names;
    for (const Json& image : json["images"])
        names.push_back(image.value("name", ""));
    return names;
}

Error makeWarning(const RuleKey& rule, const std::vector<std::string>& names)
{
    const auto& [origin, index, pattern] = rule;
    const std::string nearest = nearestMatch(pattern, names);
    return {Issue::texture_unmatched, origin, fmt::format("{}[{}]", kRules, index),
            fmt::format("'{}' matches no texture of {}{}", pattern, names.size(),
                        nearest.empty() ? "" : fmt::format("; nearest: {}", nearest))};
}

} // namespace

std::vector<Error> findUnmatchedTextures(const graph::CookSettings& settings,
                                         const std::vector<std::optional<std::string>>& statistics)
{
    std::map<RuleKey, bool> is_matched;
    std::vector<std::string> all_names;
    for (size_t source = 0; source < settings.values_of_source.size(); ++source)
    {
        const settings::Value* value = settings::findValue(settings.values_of_source[source], kRules);
        if (value == nullptr)
            continue;
        const auto names = readNames(statistics[source]);
        const Json rules = settings::toJson(*value);
        for (size_t i = 0; i < rules.size(); ++i)
        {
            const auto pattern = rules[i].value("name", "");
            const bool matches =
                !names || std::ranges::any_of(*names, [&](const std::string& name)
                                              { return tools::matchesPattern(pattern, name); });
            bool& is_known = is_matched[{value->origin, i, pattern}];
            is_known = is_known || matches;
        }
        if (names)
            all_names.insert(all_names.end(), names->begin(), names->end());
    }
    std::vector<Error> warnings;
    for (const auto& [rule, matched] : is_matched)
        if (!matched)
            warnings.push_back(makeWarning(rule, all_names));
    return warnings;
}

} // namespace hearth::command
