// What verbs share: how their results and errors are told, and options that several of them have.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/result.h"

#include <string>

namespace CLI
{
class App;
} // namespace CLI

namespace hearth::command
{

/// Tell of an error on stderr.
/// returns    its exit code
int fail(const Error& error);

int usageError(const std::string& what);

/// Results go to stdout; a pipe that does not take them is an error like any other.
int printResult(const std::string& text);
int printResult(const Result<std::string>& result);

/// --format text|json
void addFormat(CLI::App& verb, std::string& format);

/// For CLI::Validator: what is wrong with a size such as 512M, empty where nothing is.
std::string sizeFault(const std::string& text);

} // namespace hearth::command
