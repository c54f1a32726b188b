// How a cooker ended, in words of the user.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/tools/child_processes.h"
#include "formats/base/result.h"
#include "pipelines/graph/action.h"

#include <optional>
#include <string>
#include <vector>

namespace hearth::graph
{

struct Failure
{
    int exit_code = 0;
    std::string error; ///< the error line
    size_t source = 0; ///< index; their number for what is not of one
    /// Whether a cooker has said it; else nobody has, and it is still to be told.
    bool is_told = false;
    /// Whether another try may go better: the cooker was killed, by whom it does not say.
    bool is_temporary = false;
};

Failure failureOf(const Error& error, size_t source);

/// What is wrong where a cooker did not end well: its own error line, or E7001 with the subject and its last words where it
/// said nothing clear. nullopt where it ended well.
/// lines  that it has written to stderr
std::optional<Failure> failureOf(const Action& action, const tools::ChildEnd& end,
                                 const std::vector<std::string>& lines);

std::vector<std::string> linesOf(const std::string& text);
bool isError(const std::string& line);
bool isWarning(const std::string& line);

} // namespace hearth::graph
