// What verbs share: how their results and errors are told, and options that several of them have.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/command_line/command_line.h"
#include "formats/base/result.h"

#include <string>
#include <string_view>
#include <vector>

namespace hearth::command
{

/// Tell of an error on stderr.
/// returns    its exit code
int fail(const Error& error);

int usageError(const std::string& what);

/// "a, b, c", where the separator is ", ".
std::string joined(const std::vector<std::string>& words, std::string_view separator);

/// Results go to stdout; a pipe that does not take them is an error like any other.
int printResult(const std::string& text);
int printResult(const Result<std::string>& result);

/// --format text|json
void addFormat(cli::CommandLine& verb, std::string& format);

/// For Option::check: what is wrong with a size such as 512M, empty where nothing is.
std::string sizeFault(const std::string& text);

} // namespace hearth::command
