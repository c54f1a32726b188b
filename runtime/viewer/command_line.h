// Reads a command line: one file, switches, and options with a value.
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

/// Knows the options of one program, each bound to where its value goes.
class CommandLine
{
public:
    using Parse = std::function<Status(std::string_view value)>;

    /// `--name value`, or `--name=value`. A later one replaces an earlier one.
    void addValue(std::string_view name, Parse parse) { values_.emplace_back(name, std::move(parse)); }
    /// The same, taken as it stands.
    void addText(std::string_view name, std::string& text);
    void addSwitch(std::string_view name, std::function<void()> set)
    {
        switches_.emplace_back(name, std::move(set));
    }
    void addSwitch(std::string_view name, bool& flag)
    {
        addSwitch(name, [&flag] { flag = true; });
    }

    /// file  the argument that is no option; stays as it is where there is none
    /// errors: usage, naming the argument.
    Status parse(std::span<const char* const> arguments, std::string& file) const;

private:
    std::vector<std::pair<std::string_view, Parse>> values_;
    std::vector<std::pair<std::string_view, std::function<void()>>> switches_;
};

/// The error of a command line.
Error usageError(const std::string& detail);

/// The one line of an error, on stderr.
void printError(const Error& error);

/// What a program does with its command line: help on stdout, or `run(options)`. The exit code; an error is one line on stderr.
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

/// In quotation marks.
std::string quoted(std::string_view text);

} // namespace hearth::viewer
