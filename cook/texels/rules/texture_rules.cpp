// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/rules/texture_rules.h"

#include "cook/tools/name_pattern.h"
#include "cook/tools/toml_location.h"
#include "formats/base/nearest_match.h"
#include "formats/pack/image_error.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hearth::texels
{

using namespace formats;
using tools::TomlNode;
using Location = tools::TomlLocation;

namespace
{

using Keys = std::vector<std::string>;

Error unknownWord(const Location& place, Issue issue, std::string_view word, const Keys& known)
{
    const std::string nearest = nearestMatch(word, known);
    return place.wrong(issue, nearest.empty()
                                  ? fmt::format("\"{}\" is none of {}", word, fmt::join(known, ", "))
                                  : fmt::format("\"{}\" is not known: did you mean '{}'?", word, nearest));
}

/// Return the texts of an array of texts, or of one text. errors: profile_value
Result<Keys> readTexts(const TomlNode& node, const Location& place)
{
    const std::vector<TomlNode> one{node};
    Keys texts;
    for (const TomlNode& item : node.isArray() ? node.children : one)
    {
        if (!item.isText() || item.text.empty())
            return place.wrong(Issue::profile_value, "must be a text");
        texts.push_back(item.text);
    }
    return texts;
}

/// Return the only text of a node. errors: profile_value
Result<std::string> readText(const TomlNode& node, const Location& place)
{
    if (!node.isText() || node.text.empty())
        return place.wrong(Issue::profile_value, "must be a text that is not empty");
    return node.text;
}

/// Return the name of a format without its last part, which says what its numbers mean.
std::string_view baseName(std::string_view format)
{
    return format.substr(0, format.rfind('-'));
}

/// Return the names that formats of packs have in rules.
Keys formatNames()
{
    Keys names{std::string(kPlainFormat)};
    for (uint32_t format = 0; format < kTexelFormatEnd; ++format)
        if (const TexelFormatTraits* traits = findTexelFormat(format);
            traits != nullptr && !isFileFormat(traits->format))
        {
            if (const std::string base(baseName(traits->name)); std::ranges::find(names, base) == names.end())
                names.push_back(base);
            names.emplace_back(traits->name);
        }
    return names;
}

Result<Families> readFamilies(const TomlNode& node, const Location& place)
{
    HEARTH_ASSIGN_OR_RETURN(const Keys names, readTexts(node, place));
    Families families;
    for (const std::string& name : names)
        if (!addFamily(name, families))
            return unknownWord(place, Issue::profile_value, name, familyNames());
    return families;
}

Result<double> readTarget(const TomlNode& node, const Location& place)
{
    const double target = node.asNumber().value_or(0);
    if (target > 0 && target <= 100)
        return target;
    return place.wrong(Issue::profile_value, "must be a number above 0, at most 100");
}

Result<std::string> readFormat(const TomlNode& node, const Location& place)
{
    HEARTH_ASSIGN_OR_RETURN(const std::string name, readText(node, place));
    const Keys known = formatNames();
    if (std::ranges::find(known, name) == known.end())
        return unknownWord(place, Issue::profile_value, name, known);
    return name;
}

Result<TextureChoice> readChoice(const TomlNode& table, const Location& place)
{
    TextureChoice choice;
    if (const TomlNode* node = table.find("quality"))
    {
        HEARTH_ASSIGN_OR_RETURN(const std::string name, readText(*node, place.at("quality")));
        choice.quality = parseEffort(name);
        if (!choice.quality)
            return unknownWord(place.at("quality"), Issue::profile_value, name,
                               Keys(effortNames().begin(), effortNames().end()));
    }
    if (const TomlNode* node = table.find("target"))
    {
        HEARTH_ASSIGN_OR_RETURN(choice.target, readTarget(*node, place.at("target")));
    }
    if (const TomlNode* node = table.find("families"))
    {
        HEARTH_ASSIGN_OR_RETURN(choice.families, readFamilies(*node, place.at("families")));
    }
    if (const TomlNode* node = table.find("format"))
    {
        HEARTH_ASSIGN_OR_RETURN(choice.format, readFormat(*node, place.at("format")));
        if (choice.target)
            return place.wrong(Issue::profile_value, "has a format and a target: a format is not searched");
    }
    if (!choice.quality && !choice.target && !choice.families && choice.format.empty())
        return place.wrong(Issue::profile_value, "sets nothing: give it target, quality, families or format");
    return choice;
}

Result<ImageRole> readRole(const TomlNode& table, const Location& place)
{
    Keys known;
    for (auto role = static_cast<uint32_t>(ImageRole::color); role <= static_cast<uint32_t>(ImageRole::light);
         ++role)
        known.emplace_back(imageRoleName(role));
    const TomlNode* node = table.find("role");
    if (node == nullptr || !node->isText())
        return place.at("role").wrong(Issue::profile_value,
                                      fmt::format("must be one of {}", fmt::join(known, ", ")));
    const auto found = std::ranges::find(known, node->text);
    if (found == known.end())
        return unknownWord(place.at("role"), Issue::profile_value, node->text, known);
    return static_cast<ImageRole>(static_cast<ptrdiff_t>(ImageRole::color) + (found - known.begin()));
}

/// Check that a rule is a table of known members. `own` are those that say which textures it is for.
Status checkMembers(const TomlNode& table, const Location& place, Keys own)
{
    if (!table.isTable())
        return place.wrong(Issue::profile_value, "must be a table");
    Keys known = std::move(own);
    known.insert(known.end(), {"target", "quality", "families", "format"});
    for (const TomlNode& member : table.children)
        if (std::ranges::find(known, member.key) == known.end())
            return unknownWord(place, Issue::profile_key, member.key, known);
    return success();
}

Result<RoleRule> readRoleRule(const TomlNode& table, const Location& place)
{
    HEARTH_TRY(checkMembers(table, place, {"role"}));
    RoleRule rule;
    HEARTH_ASSIGN_OR_RETURN(rule.role, readRole(table, place));
    HEARTH_ASSIGN_OR_RETURN(rule.choice, readChoice(table, place));
    return rule;
}

Result<NameRule> readNameRule(const TomlNode& table, const Location& place)
{
    HEARTH_TRY(checkMembers(table, place, {"name", "path"}));
    NameRule rule{.name = "*"};
    const TomlNode* name = table.find("name");
    const TomlNode* path = table.find("path");
    if (name == nullptr && path == nullptr)
        return place.at("name").wrong(
            Issue::profile_value, "is missing: the names, or with path the sources, that the rule is for");
    if (name != nullptr)
    {
        HEARTH_ASSIGN_OR_RETURN(rule.name, readText(*name, place.at("name")));
    }
    if (path != nullptr)
    {
        HEARTH_ASSIGN_OR_RETURN(rule.path, readText(*path, place.at("path")));
    }
    HEARTH_ASSIGN_OR_RETURN(rule.choice, readChoice(table, place));
    return rule;
}

/// Set what a rule sets, over less specific settings.
void apply(const TextureChoice& rule, TextureChoice& choice)
{
    if (rule.quality || rule.target || rule.families || !rule.format.empty())
        choice.format = rule.format;
    if (rule.quality || rule.target || !rule.format.empty())
        choice.target = rule.target;
    if (rule.quality)
        choice.quality = rule.quality;
    if (rule.families)
        choice.families = rule.families;
}

} // namespace

Result<TextureRules> parseTextureRules(std::string_view text, const std::string& file)
{
    tools::TomlError fault;
    const std::optional<TomlNode> root = tools::parseToml(text, fault);
    if (!root)
        return Error{Issue::profile_syntax, file, fmt::format("line {}", fault.line), fault.text};
    TextureRules rules;
    const Location place{.file = file, .key = "textures", .has_lines = false};
    for (const TomlNode& group : root->children)
        if (group.key != "textures")
            return place.wrong(Issue::profile_key,
                               fmt::format("\"{}\" is no setting of textures", group.key));
    const TomlNode* table = root->find("textures");
    if (table == nullptr)
        return rules;
    for (const TomlNode& member : table->children)
        if (member.key != "role" && member.key != "image")
            return unknownWord(place, Issue::profile_key, member.key, {"role", "image"});
    HEARTH_TRY(tools::readRules(*table, "role", place, readRoleRule, rules.roles));
    HEARTH_TRY(tools::readRules(*table, "image", place, readNameRule, rules.images));
    return rules;
}

TextureChoice resolveChoice(const TextureRules& rules, const TextureChoice& all, ImageRole role,
                            std::string_view name)
{
    TextureChoice choice = all;
    const auto of_role =
        std::ranges::find_if(rules.roles, [&](const RoleRule& rule) { return rule.role == role; });
    if (of_role != rules.roles.end())
        apply(of_role->choice, choice);
    const auto of_name = std::ranges::find_if(rules.images, [&](const NameRule& rule)
                                              { return tools::matchesPattern(rule.name, name); });
    if (of_name != rules.images.end())
        apply(of_name->choice, choice);
    return choice;
}

bool matchesFormat(std::string_view rule, const TexelFormatTraits& format)
{
    return rule == format.name || rule == baseName(format.name) ||
           (rule == kPlainFormat && format.family == TexelFamily::plain);
}

} // namespace hearth::texels
