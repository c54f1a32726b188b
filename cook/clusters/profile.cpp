// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/profile.h"

#include "cook/tools/suggest.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <limits>
#include <toml++/toml.h>

namespace hearth::clusters
{

namespace
{

/// Where in the file a value stands, for messages.
struct Place
{
    const std::string& file;
    std::string key;

    Place at(std::string_view name) const
    {
        return {file, key.empty() ? std::string(name) : key + "." + std::string(name)};
    }
    Place at(size_t index) const { return {file, fmt::format("{}[{}]", key, index)}; }

    Error wrong(Issue issue, const toml::node& node, std::string detail) const
    {
        return {issue, file, fmt::format("line {}, {}", node.source().begin.line, key), std::move(detail)};
    }
};

using Keys = std::vector<std::string>;

/// Errors: profile_value where the node is no table, profile_key where it has a key beside `known`.
Result<const toml::table*> tableAt(const toml::node& node, const Place& place, const Keys& known)
{
    const toml::table* table = node.as_table();
    if (table == nullptr)
        return place.wrong(Issue::profile_value, node, "must be a table");
    for (const auto& [key, value] : *table)
    {
        if (std::find(known.begin(), known.end(), key.str()) != known.end())
            continue;
        const std::string nearest = tools::nearestMatch(key.str(), known);
        return place.at(key.str()).wrong(
            Issue::profile_key, value,
            nearest.empty() ? "this key is not known"
                            : fmt::format("this key is not known: did you mean '{}'?", nearest));
    }
    return table;
}

Result<const toml::array*> arrayAt(const toml::node& node, const Place& place)
{
    const toml::array* array = node.as_array();
    if (array == nullptr || array->empty())
        return place.wrong(Issue::profile_value, node, "must be an array of at least one table");
    return array;
}

/// The member's number, or `otherwise` where it is not there. errors: profile_value.
Result<float> numberAt(const toml::table& table, std::string_view name, const Place& place, float low,
                       float high, float otherwise)
{
    const toml::node* node = table.get(name);
    if (node == nullptr)
        return otherwise;
    const auto value = static_cast<float>(node->value<double>().value_or(0));
    if (node->is_number() && value >= low && value <= high)
        return value;
    return place.at(name).wrong(Issue::profile_value, *node,
                                fmt::format("must be a number from {:g} to {:g}", low, high));
}

Result<uint32_t> countAt(const toml::table& table, std::string_view name, const Place& place)
{
    const toml::node* node = table.get(name);
    const toml::node& culprit = node == nullptr ? table : *node;
    const auto* value = node == nullptr ? nullptr : node->as_integer();
    constexpr int64_t kMost = std::numeric_limits<int32_t>::max();
    if (value != nullptr && value->get() >= 1 && value->get() <= kMost)
        return static_cast<uint32_t>(value->get());
    return place.at(name).wrong(Issue::profile_value, culprit, "must be a whole number from 1 on");
}

Result<std::string> patternAt(const toml::table& table, const Place& place)
{
    const toml::node* node = table.get("name");
    const auto* text = node == nullptr ? nullptr : node->as_string();
    if (text != nullptr && !text->get().empty())
        return text->get();
    return place.at("name").wrong(Issue::profile_value, node == nullptr ? table : *node,
                                  "must be a text: the name that the rule is for, with * and ? as wildcards");
}

Result<LevelCurve> curveAt(const toml::node& node, const Place& place)
{
    HEARTH_ASSIGN_OR_RETURN(const toml::array* array, arrayAt(node, place));
    LevelCurve curve;
    for (size_t i = 0; i < array->size(); ++i)
    {
        const Place at = place.at(i);
        HEARTH_ASSIGN_OR_RETURN(const toml::table* table,
                                tableAt(*array->get(i), at, {"keep", "error_weight"}));
        LevelStep step;
        HEARTH_ASSIGN_OR_RETURN(step.keep,
                                numberAt(*table, "keep", at, kSmallestKeep, kLargestKeep, step.keep));
        HEARTH_ASSIGN_OR_RETURN(step.error_weight, numberAt(*table, "error_weight", at, 1,
                                                            kLargestErrorWeight, step.error_weight));
        curve.push_back(step);
    }
    return curve;
}

Result<std::vector<LevelTarget>> targetsAt(const toml::node& node, const Place& place)
{
    HEARTH_ASSIGN_OR_RETURN(const toml::array* array, arrayAt(node, place));
    std::vector<LevelTarget> targets;
    for (size_t i = 0; i < array->size(); ++i)
    {
        const Place at = place.at(i);
        HEARTH_ASSIGN_OR_RETURN(const toml::table* table,
                                tableAt(*array->get(i), at, {"level", "triangles"}));
        LevelTarget target;
        HEARTH_ASSIGN_OR_RETURN(target.level, countAt(*table, "level", at));
        HEARTH_ASSIGN_OR_RETURN(target.triangles, countAt(*table, "triangles", at));
        if (!targets.empty() &&
            (target.level <= targets.back().level || target.triangles >= targets.back().triangles))
            return at.wrong(Issue::profile_value, *table,
                            "must have a higher level and fewer triangles than the target before");
        targets.push_back(target);
    }
    return targets;
}

/// The member's number, if it is there. errors: profile_value.
Result<std::optional<float>> weightAt(const toml::table& table, std::string_view name, const Place& place)
{
    constexpr float kMost = 1e6f;
    if (!table.contains(name))
        return std::optional<float>();
    HEARTH_ASSIGN_OR_RETURN(const float weight, numberAt(table, name, place, 0, kMost, 0));
    return std::optional(weight);
}

/// A key with two legal numbers.
Result<std::optional<uint32_t>> choiceAt(const toml::table& table, const char* key, int64_t one,
                                         int64_t other, const Place& place)
{
    const toml::node* node = table.get(key);
    if (node == nullptr)
        return std::optional<uint32_t>();
    const auto* number = node->as_integer();
    if (number == nullptr || (number->get() != one && number->get() != other))
        return place.at(key).wrong(Issue::profile_value, *node, fmt::format("must be {} or {}", one, other));
    return std::optional(static_cast<uint32_t>(number->get()));
}

Result<MeshSettings> settingsAt(const toml::table& table, const Place& place)
{
    MeshSettings settings;
    HEARTH_ASSIGN_OR_RETURN(settings.normal_bits, choiceAt(table, "normal_bits", 8, 16, place));
    HEARTH_ASSIGN_OR_RETURN(settings.influences, choiceAt(table, "influences", 4, 8, place));
    HEARTH_ASSIGN_OR_RETURN(settings.normal_error_weight, weightAt(table, "normal_error_weight", place));
    HEARTH_ASSIGN_OR_RETURN(settings.uv_error_weight, weightAt(table, "uv_error_weight", place));
    return settings;
}

/// The keys of settingsAt beside others.
Keys withSettings(Keys keys)
{
    keys.insert(keys.end(), {"normal_bits", "normal_error_weight", "uv_error_weight", "influences"});
    return keys;
}

Result<MeshRule> meshRuleAt(const toml::node& node, const Place& place)
{
    HEARTH_ASSIGN_OR_RETURN(const toml::table* table,
                            tableAt(node, place, withSettings({"name", "levels", "targets"})));
    MeshRule rule;
    HEARTH_ASSIGN_OR_RETURN(rule.name, patternAt(*table, place));
    HEARTH_ASSIGN_OR_RETURN(rule.settings, settingsAt(*table, place));
    if (const toml::node* levels = table->get("levels"))
    {
        HEARTH_ASSIGN_OR_RETURN(rule.levels, curveAt(*levels, place.at("levels")));
    }
    if (const toml::node* targets = table->get("targets"))
    {
        HEARTH_ASSIGN_OR_RETURN(rule.targets, targetsAt(*targets, place.at("targets")));
    }
    return rule;
}

Result<MaterialRule> materialRuleAt(const toml::node& node, const Place& place)
{
    HEARTH_ASSIGN_OR_RETURN(const toml::table* table, tableAt(node, place, {"name", "levels"}));
    MaterialRule rule;
    HEARTH_ASSIGN_OR_RETURN(rule.name, patternAt(*table, place));
    const toml::node* levels = table->get("levels");
    if (levels == nullptr)
        return place.at("levels").wrong(Issue::profile_value, node, "a rule for materials needs levels");
    HEARTH_ASSIGN_OR_RETURN(rule.levels, curveAt(*levels, place.at("levels")));
    return rule;
}

/// One rule for each table of the array `name`, if that is there.
template <typename Rule>
Status readRules(const toml::table& table, std::string_view name, const Place& place,
                 Result<Rule> (*readRule)(const toml::node&, const Place&), std::vector<Rule>& rules)
{
    const toml::node* node = table.get(name);
    if (node == nullptr)
        return success();
    HEARTH_ASSIGN_OR_RETURN(const toml::array* array, arrayAt(*node, place.at(name)));
    for (size_t i = 0; i < array->size(); ++i)
    {
        HEARTH_ASSIGN_OR_RETURN(Rule rule, readRule(*array->get(i), place.at(name).at(i)));
        rules.push_back(std::move(rule));
    }
    return success();
}

Result<Profile> profileOf(const toml::table& root, const std::string& path)
{
    // the other tables are for other cookers, and hearth reads what a profile inherits
    HEARTH_TRY(tableAt(root, {path, ""},
                       {"animation", "bricks", "clusters", "import", "inherits", "textures", "visibility"}));
    Profile profile;
    const toml::node* node = root.get("clusters");
    if (node == nullptr)
        return profile;
    const Place place{path, "clusters"};
    HEARTH_ASSIGN_OR_RETURN(const toml::table* table,
                            tableAt(*node, place, withSettings({"levels", "mesh", "material"})));
    HEARTH_ASSIGN_OR_RETURN(profile.settings, settingsAt(*table, place));
    if (const toml::node* levels = table->get("levels"))
    {
        HEARTH_ASSIGN_OR_RETURN(profile.levels, curveAt(*levels, place.at("levels")));
    }
    HEARTH_TRY(readRules(*table, "mesh", place, meshRuleAt, profile.meshes));
    HEARTH_TRY(readRules(*table, "material", place, materialRuleAt, profile.materials));
    return profile;
}

} // namespace

Result<Profile> readProfile(const std::string& path)
{
    std::error_code error;
    std::ifstream file(path, std::ios::binary);
    if (!file.is_open() || std::filesystem::is_directory(path, error))
        return Error{Issue::input_missing, path, "", "the profile cannot be read"};
    return parseProfile(std::string(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()),
                        path);
}

Result<Profile> parseProfile(std::string_view text, const std::string& name)
{
    try
    {
        return profileOf(toml::parse(text), name);
    }
    catch (const toml::parse_error& wrong)
    {
        return Error{Issue::profile_syntax, name, fmt::format("line {}", wrong.source().begin.line),
                     std::string(wrong.description())};
    }
}

namespace
{

void apply(const MeshSettings& settings, Config& config)
{
    config.normal_bits = settings.normal_bits.value_or(config.normal_bits);
    config.normal_error_weight = settings.normal_error_weight.value_or(config.normal_error_weight);
    config.uv_error_weight = settings.uv_error_weight.value_or(config.uv_error_weight);
    config.influences = settings.influences.value_or(config.influences);
}

} // namespace

Config configOf(const Profile& profile, std::string_view mesh_name,
                std::span<const std::string> material_names)
{
    Config config;
    apply(profile.settings, config);
    Reduction& reduction = config.reduction;
    reduction.curve = profile.levels;
    const auto rule = std::find_if(profile.meshes.begin(), profile.meshes.end(),
                                   [&](const MeshRule& r) { return matchesPattern(r.name, mesh_name); });
    if (rule != profile.meshes.end())
    {
        apply(rule->settings, config);
        reduction.curve = rule->levels.value_or(profile.levels);
        reduction.targets = rule->targets;
    }
    for (uint32_t m = 0; m < material_names.size(); ++m)
    {
        const auto own =
            std::find_if(profile.materials.begin(), profile.materials.end(),
                         [&](const MaterialRule& r) { return matchesPattern(r.name, material_names[m]); });
        if (own != profile.materials.end())
            reduction.curve_of_material[m] = own->levels;
    }
    return config;
}

bool matchesPattern(std::string_view pattern, std::string_view text)
{
    // after a mismatch, the last * takes one character more: earlier ones need not be tried again
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

} // namespace hearth::clusters
