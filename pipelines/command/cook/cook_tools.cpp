// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/cook/cook_tools.h"

#include <algorithm>
#include <fmt/format.h>
#include <thread>
#include <unistd.h>

namespace hearth::command
{

void printMessages(const std::vector<std::string>& lines, Verbosity verbosity)
{
    for (const std::string& line : lines)
        if (graph::isError(line) || (graph::isWarning(line) && verbosity != Verbosity::quiet) ||
            verbosity == Verbosity::all)
            printMessage(line);
}

void printFaint(const std::string& line)
{
    printMessage(faint(line));
}

void printStage(const graph::Action& action, const graph::ActionOutcome& outcome)
{
    printFaint(fmt::format("{:<10}{:>8.2f} s {:>12}  {}", action.cooker, outcome.result.seconds,
                           readableSize(outcome.result.outputs.front().bytes), action.subject));
}

graph::PoolLimits makePoolLimits(unsigned jobs, uint64_t memory_bytes)
{
    constexpr unsigned kLarge = 2;
    const uint64_t machine_bytes =
        static_cast<uint64_t>(::sysconf(_SC_PHYS_PAGES)) * static_cast<uint64_t>(::sysconf(_SC_PAGESIZE));
    const uint64_t bytes = memory_bytes > 0 ? memory_bytes : machine_bytes / 4 * 3;
    if (jobs > 0)
        return {jobs, jobs, bytes};
    return {kLarge, std::max(kLarge, std::thread::hardware_concurrency()), bytes};
}

} // namespace hearth::command
