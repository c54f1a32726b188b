// Reads TOML into plain data. Only toml.cpp includes the TOML library.
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
    whole,  ///< an integer
    number, ///< any other number, also infinity and NaN
    flag,
    time, ///< a date, a time or both; its value is not stored
};

/// A value of a TOML document.
struct TomlNode
{
    TomlKind kind = TomlKind::table;
    uint32_t line = 0;   ///< start of the value, from 1; 0 if it was not read from a text
    uint32_t column = 0; ///< likewise
    std::string key;     ///< for a member of a table, else empty

    // value, stored in the member for its kind
    std::string text;
    int64_t whole = 0;
    double number = 0;
    bool flag = false;
    /// Elements of an array in order, or members of a table ordered by their keys.
    std::vector<TomlNode> children;

    bool isTable() const { return kind == TomlKind::table; }
    bool isArray() const { return kind == TomlKind::array; }
    bool isText() const { return kind == TomlKind::text; }
    bool isWhole() const { return kind == TomlKind::whole; }
    /// Return the value of an integer or other number; nullopt for all else, and for integers beyond 2^53,
    /// which a double may not hold exactly.
    std::optional<double> asNumber() const;
    /// Return the member of a table; null if it is absent, or this is no table.
    const TomlNode* find(std::string_view name) const;
};

/// Error of the parser: its position and message.
struct TomlError
{
    uint32_t line = 0;   ///< from 1
    uint32_t column = 0; ///< from 1
    std::string text;
};

/// Parse a TOML document into its root table. If it is invalid: nullopt, with the reason in `fault`.
std::optional<TomlNode> parseToml(std::string_view text, TomlError& fault);

} // namespace hearth::tools
