// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/profiles/rules_by_path.h"

#include "cook/tools/toml.h"
#include "formats/base/assert.h"
#include "pipelines/cookers/registry.h"
#include "pipelines/profiles/glob.h"
#include "pipelines/settings/toml_value.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <optional>

namespace hearth::profiles
{

using namespace settings;
using tools::TomlNode;

namespace
{

constexpr const char* kPath = "path";
constexpr const char* kName = "name";

/// Return the setting of a list whose rules may have a path; nullptr where it is none.
const Setting* findPathList(std::string_view key)
{
    const Setting* setting = findSetting(cookers::profileSettings(), key);
    const bool has_path = setting != nullptr && setting->kind == Kind::tables &&
                          findSetting(setting->members, kPath) != nullptr;
    return has_path ? setting : nullptr;
}

/// Return the rules of a list in canonical form.
TomlNode parseList(const Value& value)
{
    tools::TomlError fault;
    std::optional<TomlNode> root = tools::parseToml("x=" + value.text, fault);
    HEARTH_ASSERT(root.has_value());
    return root->children.front();
}

/// Make a rule that has a path one by name.
void removePath(TomlNode& rule)
{
    const bool has_name = rule.find(kName) != nullptr;
    for (TomlNode& member : rule.children)
        if (member.key == kPath && !has_name)
        {
            member.key = kName;
            member.text = "*";
        }
    std::erase_if(rule.children, [](const TomlNode& member) { return member.key == kPath; });
}

/// Choose the rules of one list. False where none is left.
bool selectRules(const Setting& setting, const std::string& path, Value& value)
{
    TomlNode list = parseList(value);
    TomlNode kept = list;
    kept.children.clear();
    for (size_t i = 0; i < list.children.size(); ++i)
    {
        TomlNode& rule = list.children[i];
        const TomlNode* pattern = rule.find(kPath);
        if (pattern != nullptr && !matchesPath(pattern->text, path))
            continue;
        removePath(rule);
        kept.children.push_back(rule);
        value.rule_numbers.push_back(i);
    }
    if (kept.children.empty())
        return false;
    const Result<std::string> text = canonicalText(kept, setting, {value.origin, setting.key, false});
    HEARTH_ASSERT(text.ok());
    value.text = *text;
    return true;
}

} // namespace

void selectRulesByPath(const std::string& path, Values& values)
{
    for (auto place = values.begin(); place != values.end();)
    {
        auto& [key, value] = *place;
        const Setting* setting = findPathList(key);
        const bool has_path = setting != nullptr && value.text.find(kPath) != std::string::npos;
        place = has_path && !selectRules(*setting, path, value) ? values.erase(place) : std::next(place);
    }
}

std::vector<PathRule> listPathRules(const Values& values)
{
    std::vector<PathRule> rules;
    for (const auto& [key, value] : values)
    {
        if (findPathList(key) == nullptr)
            continue;
        const TomlNode list = parseList(value);
        for (size_t i = 0; i < list.children.size(); ++i)
            if (const TomlNode* path = list.children[i].find(kPath); path != nullptr)
                rules.push_back({value.origin, fmt::format("{}[{}]", key, i), path->text});
    }
    return rules;
}

} // namespace hearth::profiles
