// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/cook_tools.h"

#include <fmt/format.h>
#include <unistd.h>

namespace hearth::command
{

void print(const std::string& line)
{
    std::fprintf(stderr, "%s\n", line.c_str());
}

int tell(const Error& error)
{
    print(formatMessage(error));
    return exitCode(error);
}

void passOn(const std::vector<std::string>& lines, Verbosity verbosity)
{
    for (const std::string& line : lines)
        if (graph::isError(line) || (graph::isWarning(line) && verbosity != Verbosity::quiet) ||
            verbosity == Verbosity::all)
            print(line);
}

void printStage(const graph::Action& action, const graph::ActionOutcome& outcome)
{
    print(faint(fmt::format("{:<10}{:>8.2f} s {:>12}  {}", action.cooker, outcome.result.seconds,
                            readableSize(outcome.result.outputs.front().bytes), action.subject)));
}

uint64_t memoryOr(uint64_t chosen_bytes)
{
    if (chosen_bytes > 0)
        return chosen_bytes;
    return static_cast<uint64_t>(::sysconf(_SC_PHYS_PAGES)) * static_cast<uint64_t>(::sysconf(_SC_PAGESIZE)) /
           4 * 3;
}

} // namespace hearth::command
