// Configuration file: hearth.toml of a project, config.toml of a user, or a profile in a file of its own.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "pipelines/settings/value.h"

#include <string>
#include <string_view>
#include <vector>

namespace hearth::profiles
{

struct Profile
{
    std::string name;
    std::string inherits; ///< name of the parent profile; empty: none
    std::string place;    ///< location of `inherits`: "line 3, column 1, profile.pc.inherits"
    settings::Values values;
};

struct Rule
{
    std::string match; ///< path pattern, see matchesPath
    /// pattern for the name of the cook's profile, with * and ? as wildcards; empty: any profile
    std::string in_profile;
    settings::Values values; ///< settings of the matching sources
    std::string place{};     ///< location of `match`: "line 10, column 9, rule[0].match"

    /// True if the rule applies in a cook with that profile; empty: a cook without a profile.
    bool appliesTo(std::string_view profile) const;
};

struct ConfigFile
{
    std::string path;          ///< as a user would type it
    settings::Values defaults; ///< settings of the command
    std::vector<Profile> profiles;
    std::vector<Rule> rules;
};

/// Parse the text of a configuration file. Strict: an unknown key or a value out of its range is an error.
///
/// has_rules  true for a project's file; a user's file has no rules
/// errors     profile_syntax, profile_key, profile_value; they name the line, the column and the key
Result<ConfigFile> parseConfig(std::string_view text, const std::string& path, bool has_rules);

/// Parse the text of a profile in a file of its own, with the content of a [profile.NAME] table.
Result<Profile> parseProfileFile(std::string_view text, const std::string& path);

} // namespace hearth::profiles
