// Describes a setting: its key, its values and its option. Validation, lists, the published schema and the
// manual are generated from these descriptions.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hearth::settings
{

enum class Kind : uint8_t
{
    flag,   ///< true or false
    whole,  ///< a whole number
    number, ///< a finite number
    choice, ///< one of several words
    text,
    texts,  ///< an array of texts, or one text
    size,   ///< bytes: a whole number, or a text such as "12G"
    tables, ///< an array of tables, at least one
};

/// Scope of a setting.
enum class Scope : uint8_t
{
    source,  ///< each source: a rule may set it
    pack,    ///< all sources together
    command, ///< the command: changes no byte of a pack
};

/// Variable of the environment that many programs use. If it is set, and neither empty nor 0, it selects a
/// value.
struct EnvironmentSwitch
{
    std::string_view variable;
    std::string_view value;
};

struct Setting
{
    std::string key; ///< "clusters.influences"; for the command "jobs"; for a member of tables its name
    Kind kind = Kind::text;
    std::string_view what;         ///< description for help, manual and schema
    std::string_view default_text; ///< description of the default; empty: none
    Scope scope = Scope::source;
    double low = 0; ///< minimum
    double high = 0;
    bool is_above_low = false; ///< true if `low` itself is not allowed
    /// words of a choice, or the allowed numbers of a whole number
    std::vector<std::string_view> choices{};
    std::string_view bare_choice{}; ///< choice that the option without a word means; empty: it needs a word
    std::string_view option{};      ///< option of hearth cook, as "--visibility-quality"; empty: --set only
    std::string_view value_name{};  ///< placeholder of the option's value in help
    std::string_view variable{};    ///< variable of the environment, for settings of the command; empty: none
    std::vector<EnvironmentSwitch> switches{}; ///< alternatives to `variable`; the first that is set counts
    bool is_required = false;                  ///< true for a mandatory member of a table
    std::vector<Setting> members{};            ///< members of tables
    /// how the setting makes its cooker faster, "draft takes fewer rays", for reports; empty: it does not
    std::string_view saving{};
    /// check beyond the ranges, of a value in canonical form; null: none. errors: profile_value
    Status (*check)(const std::string& key, const std::string& text) = nullptr;
};

/// Largest value of whole numbers that have no other limit.
inline constexpr double kMaxWholeNumber = std::numeric_limits<int32_t>::max();

/// Find a setting by key; nullptr where there is none.
const Setting* findSetting(std::span<const Setting> settings, std::string_view key);

/// Return the group of a key, "clusters" of "clusters.influences".
std::string_view settingGroup(std::string_view key);

/// Return the allowed values, to follow "must be": "a number from 0 to 180", "one of rw, ro, off".
std::string rangeText(const Setting& setting);

} // namespace hearth::settings
