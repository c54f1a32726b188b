// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/watch.h"

#include "pipelines/command/cook_tools.h"
#include "pipelines/command/file_watch.h"

#include <filesystem>
#include <fmt/format.h>

namespace hearth::command
{

namespace
{

constexpr int kUsage = 2;

} // namespace

int watch(const Configure& configure)
{
    auto files = FileWatch::create();
    if (!files.ok())
        return tell(files.error());
    Verbosity verbosity = Verbosity::normal;
    std::vector<std::string> looked_for;
    for (bool is_first = true;; is_first = false)
    {
        const auto start = std::filesystem::file_time_type::clock::now();
        std::vector<std::string> settings;
        Result<CookOptions> options = configure(settings);
        if (!options.ok() && is_first)
            return tell(options.error());
        if (options.ok())
        {
            verbosity = options->verbosity;
            options->force = options->force && is_first;
            looked_for.clear();
            const int exit_code = cook(*options, &looked_for);
            // what is wrong with the command line no edit of a file mends
            if (exit_code == kInterrupted || (exit_code == kUsage && looked_for.empty()))
                return exit_code;
            looked_for.insert(looked_for.end(), settings.begin(), settings.end());
        }
        else
            tell(options.error());
        if (const Status status = files->watch(looked_for, start); !status.ok())
            return tell(status.error());
        if (verbosity != Verbosity::quiet)
            print(faint(fmt::format("watching {} files; Ctrl-C ends", files->size())));
        const std::optional<std::string> changed = files->wait();
        if (!changed)
            return kInterrupted;
        if (verbosity != Verbosity::quiet)
            print(faint(*changed + " has changed"));
    }
}

} // namespace hearth::command
