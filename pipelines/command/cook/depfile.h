// hearth cook --depfile: what a cook has read, as make and ninja are told by compilers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "pipelines/graph/executor.h"

#include <string>
#include <vector>

namespace hearth::command
{

/// A rule as `gcc -MD -MP` writes it: `output` is made from the files that were named and from those that were found. Of
/// these each has an empty rule too, so that make goes on where a texture is gone that nothing refers to any more.
/// Escaped as make reads it (blanks, '#', '$', ':'); what else make takes for its own (';', '|', '=') it has no escape for.
/// errors: usage, where a name has a line break, which make cannot read
/// source   "Types of Prerequisites" and "Rule Syntax" of the manual of GNU make; mkdeps.c of GCC for backslashes
Result<std::string> depfileText(const std::string& output, const std::vector<std::string>& named,
                                const std::vector<std::string>& found);

/// What all actions of a cook that went well have read, as depfileText.
Result<std::string> depfileOf(const graph::Graph& graph, const graph::Executor& executor,
                              const std::string& output);

} // namespace hearth::command
