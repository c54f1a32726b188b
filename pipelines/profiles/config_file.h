// A file of settings: hearth.toml of a project, config.toml of a user, a profile in a file of its own.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/result.h"
#include "pipelines/profiles/setting.h"

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hearth::profiles
{

/// A value as TOML in one form only, so that what means the same is written the same: numbers as short as they can be, tables
/// in one line, their members in the order of the table of settings. Sizes are bytes.
struct Value
{
    std::string text;
    std::string origin; ///< where it was set, for people: "hearth.toml:12", "--jobs", "HEARTH_JOBS"
};

/// By key.
using Values = std::map<std::string, Value, std::less<>>;

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

/// A value as words: one, or more where it is an array of texts. What is a number or a table is written as in TOML.
/// errors: profile_value with `origin` as its file.
Result<Value> valueOf(const Setting& setting, const std::vector<std::string>& words,
                      const std::string& origin);

/// "clusters.influences=4", as after --set.
/// errors: profile_key, profile_value.
Result<std::pair<std::string, Value>> parseAssignment(const std::string& text);

/// The texts of a value whose setting has some; the text of a choice or text.
std::vector<std::string> textsOf(const Value& value);

/// The value as JSON.
std::string jsonOf(const Value& value);

} // namespace hearth::profiles
