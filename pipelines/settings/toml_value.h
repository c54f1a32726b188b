// Validates TOML values of settings and writes them in canonical form.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/tools/toml.h"
#include "formats/base/result.h"
#include "pipelines/settings/setting.h"

#include <string>
#include <string_view>
#include <vector>

namespace hearth::settings
{

/// Location of a node in a file, for messages.
struct TomlLocation
{
    const std::string& file;
    std::string key;
    bool has_lines = true; ///< false for values of the command line

    TomlLocation at(std::string_view name) const;
    TomlLocation at(size_t index) const;

    std::string of(const tools::TomlNode& node) const;
    Error wrong(Issue issue, const tools::TomlNode& node, std::string detail) const;
};

using Keys = std::vector<std::string>;

/// Return the error for an unknown key, with the nearest known key.
Error unknownKey(const TomlLocation& place, const tools::TomlNode& node, std::string_view key,
                 const Keys& known);

/// Return the node's value in the form of Value::text. Setting::check checks it too.
/// errors  profile_key, profile_value
Result<std::string> canonicalText(const tools::TomlNode& node, const Setting& setting,
                                  const TomlLocation& place);

} // namespace hearth::settings
