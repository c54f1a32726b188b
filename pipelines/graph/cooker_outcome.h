// Interprets how a cooker process ended, with messages in the user's terms.
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
    size_t source = 0; ///< index; source_count for actions that belong to no source
    /// True if a cooker has printed the error; else it is still to be reported.
    bool is_reported = false;
    /// True if a retry may succeed: the cooker was killed, and the killer is not known.
    bool is_temporary = false;
};

Failure makeFailure(const Error& error, size_t source);

/// Return the failure of a cooker: its own error line, or E7001 with the subject and its last line of output
/// where it printed no error. nullopt after success.
/// lines  that it wrote to stderr
std::optional<Failure> makeFailure(const Action& action, const tools::ChildOutcome& end,
                                   const std::vector<std::string>& lines);

std::vector<std::string> splitLines(const std::string& text);
bool isError(const std::string& line);
bool isWarning(const std::string& line);

} // namespace hearth::graph
