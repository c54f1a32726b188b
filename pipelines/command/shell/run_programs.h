// Runs programs of Hearth side by side for verbs that cook nothing.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/graph/cooker_outcome.h"

#include <optional>
#include <string>
#include <vector>

namespace hearth::command
{

/// Program beside this one.
struct Program
{
    std::string name;    ///< "render" is hearth-render
    std::string subject; ///< file that its errors name
    std::vector<std::string> arguments;
};

inline constexpr int kInterrupted = 130; ///< exit code after a signal

/// Run programs. The first that fails ends the others, and so does a signal.
std::optional<graph::Failure> runPrograms(const std::vector<Program>& programs);

} // namespace hearth::command
