// A file of settings: hearth.toml of a project, config.toml of a user, a profile in a file of its own.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "pipelines/profiles/value.h"

#include <string>
#include <string_view>
#include <vector>

namespace hearth::profiles
{

struct Profile
{
    std::string name;
    std::string inherits; ///< the name of another; empty: none
    std::string place;    ///< of `inherits`: "line 3, column 1, profile.pc.inherits"
    Values values;
};

struct Rule
{
    std::string match; ///< see matchesPath
    std::string
        in_profile; ///< only where the cook's profile is called so, with * and ? as wildcards; empty: always
    Values values;  ///< of sources
    std::string place{}; ///< of `match`: "line 10, column 9, rule[0].match"

    /// Whether it holds in a cook whose profile is called so; empty: that has none.
    bool holdsIn(std::string_view profile) const;
};

struct ConfigFile
{
    std::string path; ///< as people would type it
    Values defaults;  ///< of the command
    std::vector<Profile> profiles;
    std::vector<Rule> rules;
};

/// Read the text of a file of settings. Strict: a key that is not known is an error, and so is a value out of its range.
///
/// has_rules  of a project; a user's file has none
/// errors     profile_syntax, profile_key, profile_value; they name the line, the column and the key
Result<ConfigFile> parseConfig(std::string_view text, const std::string& path, bool has_rules);

/// Read the text of a profile in a file of its own: what would stand in [profile.NAME].
Result<Profile> parseProfileFile(std::string_view text, const std::string& path);

} // namespace hearth::profiles
