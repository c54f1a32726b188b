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

/// Of -q and -v, which exclude each other.
inline Verbosity verbosityOf(bool quiet, bool verbose)
{
    return quiet ? Verbosity::quiet : verbose ? Verbosity::all : Verbosity::normal;
}

enum class ColorWish
{
    automatic,
    always,
    never,
};

/// Of --color, which goes over the environment; before anything is printed.
void setColor(ColorWish wish);

/// Whether stderr is a terminal that wants colour: NO_COLOR, TERM=dumb and CI say no, CLICOLOR_FORCE says yes; --color over all.
bool colorOnStderr();

/// `text` faint, where stderr shows colours.
std::string faint(std::string_view text);

/// "12.3 MiB", "310 B".
std::string readableSize(uint64_t bytes);

} // namespace hearth::command
