// What TOML says of a setting: checked, and written in one form. For the files of this folder alone.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/tools/toml.h"
#include "formats/base/result.h"
#include "pipelines/profiles/setting.h"

#include <string>
#include <string_view>
#include <vector>

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

    std::string of(const tools::TomlNode& node) const;
    Error wrong(Issue issue, const tools::TomlNode& node, std::string detail) const;
};

using Keys = std::vector<std::string>;

/// The error of a key that is none of those that are known, with the nearest of them.
Error unknownKey(const Place& place, const tools::TomlNode& node, std::string_view key, const Keys& known);

/// The node's value as Value::text has it. What the cooker itself says of it counts, too: values of several members may not
/// go together.
/// errors  profile_key, profile_value
Result<std::string> checkedTextOf(const tools::TomlNode& node, const Setting& setting, const Place& place);

} // namespace hearth::profiles
