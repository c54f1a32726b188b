// Command line parser: one file, switches, and options with a value.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <cstdio>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hearth::viewer
{

/// Options of one program, each bound to its destination.
class CommandLine
{
public:
    using Parse = std::function<Status(std::string_view value)>;

    /// Add `--name value` or `--name=value`. A repeated option replaces the earlier value.
    void addValue(std::string_view name, Parse parse) { values_.emplace_back(name, std::move(parse)); }
    /// Add an option whose value is taken verbatim.
    void addText(std::string_view name, std::string& text);
    void addSwitch(std::string_view name, std::function<void()> set)
    {
        switches_.emplace_back(name, std::move(set));
    }
    void addSwitch(std::string_view name, bool& flag)
    {
        addSwitch(name, [&flag] { flag = true; });
    }

    /// file  the argument that is no option; unchanged if there is none
    /// errors: usage, naming the argument.
    Status parse(std::span<const char* const> arguments, std::string& file) const;

private:
    std::vector<std::pair<std::string_view, Parse>> values_;
    std::vector<std::pair<std::string_view, std::function<void()>>> switches_;
};

/// Make the error of a command line.
Error usageError(const std::string& detail);

/// Print an error as one line on stderr.
void printError(const Error& error);

/// Parse the command line of a program, then print help on stdout or call `run(options)`. Returns the exit
/// code; prints an error as one line on stderr.
template <typename Options, typename Run>
int runCommand(const Result<Options>& options, const std::string& help, const Run& run)
{
    if (options.ok() && options->help)
    {
        std::fputs(help.c_str(), stdout);
        return 0;
    }
    const Status status = options.ok() ? run(*options) : Status(options.error());
    if (status.ok())
        return 0;
    printError(status.error());
    return exitCode(status.error());
}

/// Return the text in quotation marks.
std::string quoted(std::string_view text);

} // namespace hearth::viewer
