// The value of a setting, with where it was set.
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

/// A value as TOML in one form only, so that what means the same is written the same: numbers as short as they can be, tables
/// in one line, their members in the order of the table of settings. Sizes are bytes.
struct Value
{
    std::string text;
    std::string origin; ///< where it was set, for people: "hearth.toml:12", "--jobs", "HEARTH_JOBS"
};

/// By key.
using Values = std::map<std::string, Value, std::less<>>;

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
Json jsonOf(const Value& value);

} // namespace hearth::profiles
