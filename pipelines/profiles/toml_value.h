// What TOML says of a setting: checked, and written in one form. For the files of this folder alone.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/result.h"
#include "pipelines/profiles/setting.h"

#include <string>
#include <string_view>
#include <vector>

// toml++ stays in .cpp files; release 3 has its names here
namespace toml
{
inline namespace v3
{
class node;
} // namespace v3
} // namespace toml

namespace hearth::profiles
{

/// Where in a file a node stands, for messages.
struct Place
{
    const std::string& file;
    std::string key;
    bool has_lines = true; ///< what stands on a command line has none

    Place at(std::string_view name) const;
    Place at(size_t index) const;

    std::string of(const toml::node& node) const;
    Error wrong(Issue issue, const toml::node& node, std::string detail) const;
};

using Keys = std::vector<std::string>;

/// The error of a key that is none of those that are known, with the nearest of them.
Error unknownKey(const Place& place, const toml::node& node, std::string_view key, const Keys& known);

/// The node's value as Value::text has it. What the cooker itself says of it counts, too: values of several members may not
/// go together.
/// errors  profile_key, profile_value
Result<std::string> checkedTextOf(const toml::node& node, const Setting& setting, const Place& place);

} // namespace hearth::profiles
