// Helpers of all verbs: print results and errors, and add options that several verbs have.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/command_line/command_line.h"
#include "formats/base/result.h"
#include "pipelines/command/shell/messages.h"

#include <string>
#include <string_view>
#include <vector>

namespace hearth::command
{

int printUsageError(const std::string& what);

/// Join words: "a, b, c" with the separator ", ".
std::string joinWords(const std::vector<std::string>& words, std::string_view separator);

/// Print a result to stdout. A pipe that does not take it is an error like any other.
/// returns    the exit code
int printResult(const std::string& text);
int printResult(const Result<std::string>& result);

/// Add the option --format text|json.
void addFormat(cli::CommandLine& verb, std::string& format);

/// Return the fault of a size such as 512M, empty if it is valid; for Option::check.
std::string sizeFault(const std::string& text);

} // namespace hearth::command
