// The table of everything that a profile can set, and of the options of the command that a file can set: what is checked,
// listed, published as a schema and printed in the manual comes from here.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hearth::profiles
{

enum class Kind : uint8_t
{
    flag,   ///< true or false
    whole,  ///< a whole number
    number, ///< a finite number
    choice, ///< one of some words
    text,
    texts,  ///< an array of texts, or one text
    size,   ///< bytes: a whole number, or a text as "12G"
    tables, ///< an array of tables, at least one
};

/// Whose a setting is.
enum class Scope : uint8_t
{
    source,  ///< of each source: a rule may set it
    pack,    ///< of all sources together
    command, ///< of the command line: it changes no byte of a pack
};

/// A variable of the environment that many programs know: set, and neither empty nor 0, it chooses a value.
struct Switch
{
    std::string_view variable;
    std::string_view value;
};

/// How a setting makes cooking cheaper.
struct Saving
{
    std::string_view cooker; ///< "visibility" is hearth-visibility; empty: it does not
    std::string_view advice; ///< "draft takes fewer rays"
};

struct Setting
{
    std::string key; ///< "clusters.influences"; of the command: "jobs"; of a member of tables: its name
    Kind kind = Kind::text;
    std::string_view what;      ///< for help, manual and schema
    std::string_view otherwise; ///< what holds where nobody sets it; empty: nothing
    Scope scope = Scope::source;
    double low = 0; ///< least number
    double high = 0;
    bool is_above_low = false; ///< `low` itself is not allowed
    std::vector<std::string_view>
        choices{};                  ///< of a choice, or of a whole number where only some are allowed
    std::string_view option{};      ///< of hearth cook, as "--visibility-quality"; empty: --set alone
    std::string_view value_name{};  ///< what stands for the option's value in help
    std::string_view variable{};    ///< of the environment, for the command's; empty: none
    std::vector<Switch> switches{}; ///< instead of it; the first that is set counts
    bool is_required = false;       ///< a member without which its table makes no sense
    std::vector<Setting> members{}; ///< of tables
    Saving saving{};                ///< for reports of what was slow
};

/// Which files are levels of detail of a source. It says what is cooked, so that no cooker is told of it.
inline constexpr std::string_view kImportLods = "import.lods";

/// What a profile can set: of sources, then of the pack.
std::span<const Setting> profileSettings();

/// What the table [defaults] can set.
std::span<const Setting> commandSettings();

/// nullptr where there is none of that key.
const Setting* findSetting(std::span<const Setting> settings, std::string_view key);

/// "clusters" of "clusters.influences".
std::string_view groupOf(std::string_view key);

/// What a value must be, to stand after "must be": "a number from 0 to 180", "one of rw, ro, off".
std::string rangeText(const Setting& setting);

} // namespace hearth::profiles
