// What the user sees on stderr while a command works.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace hearth::command
{

enum class Verbosity
{
    quiet,  ///< errors only
    normal, ///< and warnings, and a line for each stage
    all,    ///< and the command line of each stage
};

enum class ColorWish
{
    automatic,
    always,
    never,
};

/// As the settings say, before anything is printed; automatic where nobody has said it.
void setColor(ColorWish wish);

/// Whether stderr gets colours. Where that is automatic: NO_COLOR says no, CLICOLOR_FORCE says yes; else where it is a terminal,
/// unless TERM=dumb or CI say no.
bool colorOnStderr();

/// `text` faint, where stderr shows colours.
std::string faint(std::string_view text);

/// "12.3 MiB", "310 B".
std::string readableSize(uint64_t bytes);

} // namespace hearth::command
