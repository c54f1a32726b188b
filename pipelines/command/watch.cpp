// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/watch.h"

#include "pipelines/command/file_watch.h"

#include <filesystem>
#include <fmt/format.h>

namespace hearth::command
{

namespace
{

constexpr int kInterrupted = 130;
constexpr int kUsage = 2;

int fail(const Error& error)
{
    std::fprintf(stderr, "%s\n", formatMessage(error).c_str());
    return exitCode(error);
}

void say(const CookOptions& options, const std::string& line)
{
    if (options.verbosity != Verbosity::quiet)
        std::fprintf(stderr, "%s\n", faint(line).c_str());
}

} // namespace

int watch(const CookOptions& chosen)
{
    CookOptions options = chosen;
    auto files = FileWatch::create();
    if (!files.ok())
        return fail(files.error());
    for (;;)
    {
        const auto start = std::filesystem::file_time_type::clock::now();
        std::vector<std::string> looked_for;
        const int exit_code = cook(options, &looked_for);
        // what is wrong with the command line no edit of a file mends
        if (exit_code == kInterrupted || (exit_code == kUsage && looked_for.empty()))
            return exit_code;
        options.force = false;
        if (const Status status = files->watch(looked_for, start); !status.ok())
            return fail(status.error());
        say(options, fmt::format("watching {} files; Ctrl-C ends", files->size()));
        const std::optional<std::string> changed = files->wait();
        if (!changed)
            return kInterrupted;
        say(options, *changed + " has changed");
    }
}

} // namespace hearth::command
