// Messages on stderr: as lines for people, or as JSON for programs.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace hearth::command
{

enum class MessageForm : uint8_t
{
    text,
    json, ///< an object a line
};

/// Of all that follows; a process has one stderr.
void setMessageForm(MessageForm form);
MessageForm messageForm();

/// The parts of "file|where: error: text [E1203] hint: what to do"; of a line in no such form, "text" alone.
struct MessageParts
{
    std::string severity; ///< "error", "warning", or "note"
    std::string file;
    std::string where;
    std::string text;
    std::string code; ///< "E1203"
    std::string hint;
};
MessageParts partsOf(std::string_view line);

/// Print a line, its "error:" or "warning:" in colour where stderr has some; or as JSON.
void tell(const std::string& line);

/// How many lines tell() has printed.
size_t countTold();

} // namespace hearth::command
