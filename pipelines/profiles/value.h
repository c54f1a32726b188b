// Value of a setting, with the place where it was set.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "pipelines/profiles/setting.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace hearth
{
class Json;
}

namespace hearth::profiles
{

/// Value as canonical TOML, so that equal values have equal texts: shortest form of numbers, tables in one
/// line, their members in the order of the table of settings. Sizes are in bytes.
struct Value
{
    std::string text;
    std::string origin; ///< place where it was set, for users: "hearth.toml:12", "--jobs", "HEARTH_JOBS"
};

/// Values by key.
using Values = std::map<std::string, Value, std::less<>>;

/// Parse a value from words: one, or several for an array of texts. Numbers and tables are in TOML syntax.
/// errors: profile_value with `origin` as its file.
Result<Value> parseValue(const Setting& setting, const std::vector<std::string>& words,
                         const std::string& origin);

/// Parse an assignment as it follows --set, such as "clusters.influences=4".
/// errors: profile_key, profile_value.
Result<std::pair<std::string, Value>> parseAssignment(const std::string& text);

/// Return the texts of a value of kind texts, or the one text of a choice or text.
std::vector<std::string> valueTexts(const Value& value);

/// Convert the value to JSON.
Json toJson(const Value& value);

} // namespace hearth::profiles
