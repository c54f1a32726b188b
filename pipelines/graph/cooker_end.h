// How a cooker ended, in words of the user.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/tools/child_processes.h"
#include "formats/result.h"
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
};

Failure failureOf(const Error& error, size_t source);

/// What a cooker was told, where it said nothing clear itself: E7001 that names the subject and the cooker's last words.
std::optional<Failure> failureOf(const Action& action, const tools::ChildEnd& end,
                                 const std::vector<std::string>& lines);

std::vector<std::string> linesOf(const std::string& text);
bool isError(const std::string& line);
bool isWarning(const std::string& line);

} // namespace hearth::graph
