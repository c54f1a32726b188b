// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/program/profile.h"

#include "cook/tools/name_pattern.h"
#include "cook/tools/toml_location.h"
#include "formats/base/nearest_match.h"
#include "formats/base/regular_file.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace hearth::clusters
{

namespace
{

using tools::TomlNode;
using Location = tools::TomlLocation;

using Keys = std::vector<std::string>;

Error unknownKey(const TomlNode& member, const Location& place, const std::string& nearest)
{
    return place.at(member.key)
        .wrong(Issue::profile_key, member,
               nearest.empty() ? "this key is not known"
                               : fmt::format("this key is not known: did you mean '{}'?", nearest));
}

/// Errors: profile_value if the node is no table, profile_key if it has a key that is not in `known`.
Result<const TomlNode*> tableAt(const TomlNode& node, const Location& place, const Keys& known)
{
    if (!node.isTable())
        return place.wrong(Issue::profile_value, node, "must be a table");
    for (const TomlNode& member : node.children)
        if (std::find(known.begin(), known.end(), member.key) == known.end())
            return unknownKey(member, place, nearestMatch(member.key, known));
    return &node;
}

Result<const TomlNode*> arrayAt(const TomlNode& node, const Location& place)
{
    if (!node.isArray() || node.children.empty())
        return place.wrong(Issue::profile_value, node, "must be an array of at least one table");
    return &node;
}

/// Return the member's number, or `otherwise` if it is missing. errors: profile_value.
Result<float> numberAt(const TomlNode& table, std::string_view name, const Location& place, float low,
                       float high, float otherwise)
{
    const TomlNode* node = table.find(name);
    if (node == nullptr)
        return otherwise;
    const auto value = static_cast<float>(node->asNumber().value_or(NAN));
    if (value >= low && value <= high)
        return value;
    return place.at(name).wrong(Issue::profile_value, *node,
                                fmt::format("must be a number from {:g} to {:g}", low, high));
}

Result<uint32_t> countAt(const TomlNode& table, std::string_view name, const Location& place)
{
    const TomlNode* node = table.find(name);
    const TomlNode& culprit = node == nullptr ? table : *node;
    constexpr int64_t kMaxValue = std::numeric_limits<int32_t>::max();
    if (node != nullptr && node->isWhole() && node->whole >= 1 && node->whole <= kMaxValue)
        return static_cast<uint32_t>(node->whole);
    return place.at(name).wrong(Issue::profile_value, culprit, "must be a whole number from 1 on");
}

Result<std::string> patternAt(const TomlNode& table, const Location& place)
{
    const TomlNode* node = table.find("name");
    if (node != nullptr && node->isText() && !node->text.empty())
        return node->text;
    return place.at("name").wrong(Issue::profile_value, node == nullptr ? table : *node,
                                  "must be a text: the name that the rule is for, with * and ? as wildcards");
}

Result<LevelCurve> curveAt(const TomlNode& node, const Location& place)
{
    HEARTH_ASSIGN_OR_RETURN(const TomlNode* array, arrayAt(node, place));
    LevelCurve curve;
    for (size_t i = 0; i < array->children.size(); ++i)
    {
        const Location at = place.at(i);
        HEARTH_ASSIGN_OR_RETURN(const TomlNode* table,
                                tableAt(array->children[i], at, {"keep", "error_weight"}));
        LevelStep step;
        HEARTH_ASSIGN_OR_RETURN(step.keep, numberAt(*table, "keep", at, kMinKeep, kMaxKeep, step.keep));
        HEARTH_ASSIGN_OR_RETURN(step.error_weight,
                                numberAt(*table, "error_weight", at, 1, kMaxErrorWeight, step.error_weight));
        curve.push_back(step);
    }
    return curve;
}

Result<std::vector<LevelTarget>> targetsAt(const TomlNode& node, const Location& place)
{
    HEARTH_ASSIGN_OR_RETURN(const TomlNode* array, arrayAt(node, place));
    std::vector<LevelTarget> targets;
    for (size_t i = 0; i < array->children.size(); ++i)
    {
        const Location at = place.at(i);
        HEARTH_ASSIGN_OR_RETURN(const TomlNode* table,
                                tableAt(array->children[i], at, {"level", "triangles"}));
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

/// Return the member's number, if it exists. errors: profile_value.
Result<std::optional<float>> weightAt(const TomlNode& table, std::string_view name, const Location& place)
{
    constexpr float kMaxValue = 1e6f;
    if (table.find(name) == nullptr)
        return std::optional<float>();
    HEARTH_ASSIGN_OR_RETURN(const float weight, numberAt(table, name, place, 0, kMaxValue, 0));
    return std::optional(weight);
}

/// Read a key with two legal numbers.
Result<std::optional<uint32_t>> choiceAt(const TomlNode& table, const char* key, int64_t one, int64_t other,
                                         const Location& place)
{
    const TomlNode* node = table.find(key);
    if (node == nullptr)
        return std::optional<uint32_t>();
    if (!node->isWhole() || (node->whole != one && node->whole != other))
        return place.at(key).wrong(Issue::profile_value, *node, fmt::format("must be {} or {}", one, other));
    return std::optional(static_cast<uint32_t>(node->whole));
}

Result<MeshSettings> settingsAt(const TomlNode& table, const Location& place)
{
    MeshSettings settings;
    HEARTH_ASSIGN_OR_RETURN(settings.normal_bits, choiceAt(table, "normal_bits", 8, 16, place));
    HEARTH_ASSIGN_OR_RETURN(settings.influences, choiceAt(table, "influences", 4, 8, place));
    HEARTH_ASSIGN_OR_RETURN(settings.normal_error_weight, weightAt(table, "normal_error_weight", place));
    HEARTH_ASSIGN_OR_RETURN(settings.uv_error_weight, weightAt(table, "uv_error_weight", place));
    return settings;
}

/// Append the keys of settingsAt.
Keys withSettings(Keys keys)
{
    keys.insert(keys.end(), {"normal_bits", "normal_error_weight", "uv_error_weight", "influences"});
    return keys;
}

Result<MeshRule> meshRuleAt(const TomlNode& node, const Location& place)
{
    HEARTH_ASSIGN_OR_RETURN(const TomlNode* table,
                            tableAt(node, place, withSettings({"name", "levels", "targets"})));
    MeshRule rule;
    HEARTH_ASSIGN_OR_RETURN(rule.name, patternAt(*table, place));
    HEARTH_ASSIGN_OR_RETURN(rule.settings, settingsAt(*table, place));
    if (const TomlNode* levels = table->find("levels"))
    {
        HEARTH_ASSIGN_OR_RETURN(rule.levels, curveAt(*levels, place.at("levels")));
    }
    if (const TomlNode* targets = table->find("targets"))
    {
        HEARTH_ASSIGN_OR_RETURN(rule.targets, targetsAt(*targets, place.at("targets")));
    }
    return rule;
}

Result<MaterialRule> materialRuleAt(const TomlNode& node, const Location& place)
{
    HEARTH_ASSIGN_OR_RETURN(const TomlNode* table, tableAt(node, place, {"name", "levels"}));
    MaterialRule rule;
    HEARTH_ASSIGN_OR_RETURN(rule.name, patternAt(*table, place));
    const TomlNode* levels = table->find("levels");
    if (levels == nullptr)
        return place.at("levels").wrong(Issue::profile_value, node, "a rule for materials needs levels");
    HEARTH_ASSIGN_OR_RETURN(rule.levels, curveAt(*levels, place.at("levels")));
    return rule;
}

Result<Profile> makeProfile(const TomlNode& root, const std::string& path)
{
    // other tables are for other cookers, and hearth resolves `inherits`; only a misspelt name is an error
    const Keys own{"clusters"};
    for (const TomlNode& member : root.children)
        if (const std::string nearest = nearestMatch(member.key, own);
            !nearest.empty() && nearest != member.key)
            return unknownKey(member, {path, ""}, nearest);
    Profile profile;
    const TomlNode* node = root.find("clusters");
    if (node == nullptr)
        return profile;
    const Location place{path, "clusters"};
    HEARTH_ASSIGN_OR_RETURN(const TomlNode* table,
                            tableAt(*node, place, withSettings({"levels", "mesh", "material"})));
    HEARTH_ASSIGN_OR_RETURN(profile.settings, settingsAt(*table, place));
    if (const TomlNode* levels = table->find("levels"))
    {
        HEARTH_ASSIGN_OR_RETURN(profile.levels, curveAt(*levels, place.at("levels")));
    }
    HEARTH_TRY(tools::readRules(*table, "mesh", place, meshRuleAt, profile.meshes));
    HEARTH_TRY(tools::readRules(*table, "material", place, materialRuleAt, profile.materials));
    return profile;
}

} // namespace

Result<Profile> readProfile(const std::string& path)
{
    HEARTH_ASSIGN_OR_RETURN(const std::string text, readFile(path));
    return parseProfile(text, path);
}

Result<Profile> parseProfile(std::string_view text, const std::string& name)
{
    tools::TomlError fault;
    const std::optional<TomlNode> root = tools::parseToml(text, fault);
    if (!root)
        return Error{Issue::profile_syntax, name, fmt::format("line {}", fault.line), fault.text};
    return makeProfile(*root, name);
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

Config resolveConfig(const Profile& profile, std::string_view mesh_name,
                     std::span<const std::string> material_names)
{
    Config config;
    apply(profile.settings, config);
    Reduction& reduction = config.reduction;
    reduction.curve = profile.levels;
    const auto rule =
        std::find_if(profile.meshes.begin(), profile.meshes.end(),
                     [&](const MeshRule& r) { return tools::matchesPattern(r.name, mesh_name); });
    if (rule != profile.meshes.end())
    {
        apply(rule->settings, config);
        reduction.curve = rule->levels.value_or(profile.levels);
        reduction.targets = rule->targets;
    }
    for (uint32_t m = 0; m < material_names.size(); ++m)
    {
        const auto own = std::find_if(profile.materials.begin(), profile.materials.end(),
                                      [&](const MaterialRule& r)
                                      { return tools::matchesPattern(r.name, material_names[m]); });
        if (own != profile.materials.end())
            reduction.curve_of_material[m] = own->levels;
    }
    return config;
}

} // namespace hearth::clusters
