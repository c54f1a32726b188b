// Prints messages on stderr: as lines for people, or as JSON for programs.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace hearth::command
{

enum class MessageFormat : uint8_t
{
    text,
    json, ///< an object per line
};

/// Set the form of all later messages. It is global, because a process has one stderr.
void setMessageFormat(MessageFormat form);
MessageFormat messageFormat();

/// Parts of "file|where: error: text [E1203] hint: what to do". A line of another form is all `text`, with
/// severity "note".
struct MessageParts
{
    std::string severity; ///< "error", "warning", or "note"
    std::string file;
    std::string where;
    std::string text;
    std::string code; ///< "E1203"
    std::string hint;
};
/// Split a line into its parts.
MessageParts splitMessage(std::string_view line);

/// Print a line, with its "error:" or "warning:" in colour if stderr shows colours; or as JSON.
void printMessage(const std::string& line);

/// Print an error or a warning on stderr. returns  its exit code
int printError(const Error& error);

/// Return the number of lines that printMessage() has printed.
size_t countPrinted();

} // namespace hearth::command
