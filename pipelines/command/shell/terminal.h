// Style of messages on stderr: verbosity, colours, readable sizes.
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
    normal, ///< also warnings, and a line for each stage
    all,    ///< also the command line of each stage
};

enum class ColorChoice
{
    automatic,
    always,
    never,
};

/// Set the user's choice, before anything is printed; automatic if there is none.
void setColorChoice(ColorChoice choice);

/// True if stderr gets colours. If the choice is automatic, NO_COLOR disables them and CLICOLOR_FORCE enables
/// them; else they are used if stderr is a terminal, unless TERM=dumb or CI is set.
bool isStderrColored();

/// Return `text` in faint style if stderr shows colours.
std::string faint(std::string_view text);

/// Format a number of bytes: "12.3 MiB", "310 B".
std::string readableSize(uint64_t bytes);

} // namespace hearth::command
