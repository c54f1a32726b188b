// Value of a setting, with the place where it was set.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "pipelines/settings/setting.h"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace hearth
{
class Json;
}

namespace hearth::settings
{

/// Value as canonical TOML, so that equal values have equal texts: shortest form of numbers, tables in one
/// line, their members in the order of the table of settings. Sizes are in bytes.
struct Value
{
    std::string text;
    std::string origin; ///< place where it was set, for users: "hearth.toml:12", "--jobs", "HEARTH_JOBS"
    /// of tables some of which were left out: number of each that is there, among all; else empty
    std::vector<size_t> rule_numbers{};
};

/// Values by key.
using Values = std::map<std::string, Value, std::less<>>;

/// Parse a value from words: one, or several for an array of texts. Numbers and tables are in TOML syntax.
/// errors: profile_value with `origin` as its file.
Result<Value> parseValue(const Setting& setting, const std::vector<std::string>& words,
                         const std::string& origin);

/// Parse the part of an assignment behind '='; texts may have quotation marks, as in TOML.
/// errors: as parseValue
Result<Value> parseAssignedValue(const Setting& setting, const std::string& text, const std::string& origin);

/// Find a value; nullptr where it is not set.
const Value* findValue(const Values& values, std::string_view key);

/// True if a flag is set to true.
bool isOn(const Values& values, std::string_view key);

/// Return the word of a choice; `otherwise` where it is not set.
std::string choiceOr(const Values& values, std::string_view key, std::string_view otherwise);

/// Return the texts of a value of kind texts, or the one text of a choice or text.
std::vector<std::string> valueTexts(const Value& value);

/// Convert the value to JSON.
Json toJson(const Value& value);

} // namespace hearth::settings
