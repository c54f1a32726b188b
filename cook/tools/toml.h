// Reads TOML into plain data. The one file that includes a library for TOML is toml.cpp.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hearth::tools
{

enum class TomlKind : uint8_t
{
    table,
    array,
    text,
    whole,  ///< a whole number
    number, ///< any other number, also one that is infinite or none
    flag,
    time, ///< a date, a time or both; its value is not kept
};

/// A value of a TOML document.
struct TomlNode
{
    TomlKind kind = TomlKind::table;
    uint32_t line = 0;   ///< where it begins, counted from 1; 0 where it was not read from a text
    uint32_t column = 0; ///< the same
    std::string key;     ///< of a member of a table, else empty

    // the value, in the member of its kind
    std::string text;
    int64_t whole = 0;
    double number = 0;
    bool flag = false;
    std::vector<TomlNode>
        children; ///< elements of an array in order, members of a table in the order of their keys

    bool isTable() const { return kind == TomlKind::table; }
    bool isArray() const { return kind == TomlKind::array; }
    bool isText() const { return kind == TomlKind::text; }
    bool isWhole() const { return kind == TomlKind::whole; }
    /// A number, whole or not; nullopt for all else, and for a whole number that no double has.
    std::optional<double> asNumber() const;
    /// The member of a table; null where there is none, or this is no table.
    const TomlNode* find(std::string_view name) const;
};

/// Why a text is no TOML.
struct TomlFault
{
    uint32_t line = 0;   ///< from 1
    uint32_t column = 0; ///< from 1
    std::string text;
};

/// The table that a whole text describes. Where it is no TOML: nullopt, and `fault` says why.
std::optional<TomlNode> parseToml(std::string_view text, TomlFault& fault);

} // namespace hearth::tools
