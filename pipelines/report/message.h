// Messages of cookers as their parts.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <string>
#include <string_view>

namespace hearth::report
{

/// "FILE|POINTER: error: TEXT [E1203] hint: HINT", as formatMessage writes it.
struct Message
{
    std::string file;
    std::string pointer;
    std::string severity; ///< "error" or "warning"
    std::string code;     ///< "E1203"
    std::string text;
    std::string hint;
};

/// What is not there is empty; a line that is no message is all text.
Message parseMessage(std::string_view line);

} // namespace hearth::report
