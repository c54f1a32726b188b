// Parser for messages of cookers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <string>
#include <string_view>

namespace hearth::graph
{

/// Message of the form "FILE|POINTER: error: TEXT [E1203] hint: HINT", as formatMessage writes it.
struct Message
{
    std::string file;
    std::string pointer;
    std::string severity; ///< "error" or "warning"
    std::string code;     ///< "E1203"
    std::string text;
    std::string hint;
};

/// Parse a message. Missing members are empty; a line that is not a message becomes `text`.
Message parseMessage(std::string_view line);

} // namespace hearth::graph
