// Location of a value in TOML, for messages, and lists of rules.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/tools/toml.h"
#include "formats/base/result.h"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hearth::tools
{

struct TomlLocation
{
    const std::string& file; ///< outlives the location
    std::string key;         ///< from the root on, "a.b[2]"; empty: the root
    bool has_lines = true;   ///< false for a value that was joined to one line

    TomlLocation at(std::string_view name) const
    {
        return {file, key.empty() ? std::string(name) : key + "." + std::string(name), has_lines};
    }
    TomlLocation at(size_t index) const { return {file, key + "[" + std::to_string(index) + "]", has_lines}; }

    Error wrong(Issue issue, std::string detail) const { return {issue, file, key, std::move(detail)}; }
    /// Name the line of the node, too, where there are lines.
    Error wrong(Issue issue, const TomlNode& node, std::string detail) const
    {
        return has_lines
                   ? Error{issue, file, "line " + std::to_string(node.line) + ", " + key, std::move(detail)}
                   : wrong(issue, std::move(detail));
    }
};

/// Read one rule for each table of the array `name`, if it exists. errors: profile_value, those of readRule.
template <typename Rule>
Status readRules(const TomlNode& table, std::string_view name, const TomlLocation& place,
                 Result<Rule> (*readRule)(const TomlNode&, const TomlLocation&), std::vector<Rule>& rules)
{
    const TomlNode* const array = table.find(name);
    if (array == nullptr)
        return success();
    if (!array->isArray() || array->children.empty())
        return place.at(name).wrong(Issue::profile_value, *array, "must be an array of at least one table");
    for (size_t i = 0; i < array->children.size(); ++i)
    {
        HEARTH_ASSIGN_OR_RETURN(Rule rule, readRule(array->children[i], place.at(name).at(i)));
        rules.push_back(std::move(rule));
    }
    return success();
}

} // namespace hearth::tools
