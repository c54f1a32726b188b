// hearth cook --depfile: writes the files that a cook has read as a dependency file for make and ninja.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "pipelines/graph/executor.h"

#include <string>
#include <vector>

namespace hearth::command
{

/// Write a rule as `gcc -MD -MP` does: `output` depends on the files `named` and `found`. Each found file has
/// an empty rule too, so that make goes on if a texture is gone that nothing refers to any more. Blanks, '#',
/// '$' and ':' are escaped for make, which has no escape for its other special characters (';', '|', '=').
/// errors: usage if a name has a line break, which make cannot read
/// source   "Types of Prerequisites" and "Rule Syntax" of the manual of GNU make; mkdeps.c of GCC for
///          backslashes
Result<std::string> depfileText(const std::string& output, const std::vector<std::string>& named,
                                const std::vector<std::string>& found);

/// Write the dependencies of a cook that succeeded: everything that its actions have read, as depfileText.
Result<std::string> makeDepfile(const graph::Graph& graph, const graph::Executor& executor,
                                const std::string& output);

} // namespace hearth::command
