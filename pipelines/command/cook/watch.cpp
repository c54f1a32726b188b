// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/cook/watch.h"

#include "pipelines/command/cook/cook_tools.h"
#include "pipelines/command/sources/file_watch.h"
#include "pipelines/command/sources/source_list.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace hearth::command
{

namespace
{

constexpr int kUsage = 2;

/// Return the files that the words stand for now; none if a word stands for nothing, which the next cook
/// reports.
std::vector<std::string> currentSources(const std::vector<std::string>& words)
{
    const Result<std::vector<std::string>> sources = expandSources(words);
    return sources.ok() ? *sources : std::vector<std::string>();
}

/// Return a path that only one of two unlike lists has.
std::string firstChange(const std::vector<std::string>& before, const std::vector<std::string>& now)
{
    const auto [old, fresh] = std::mismatch(before.begin(), before.end(), now.begin(), now.end());
    return now.size() < before.size() ? *old : *fresh;
}

/// Wait until one of the files changes, or the words stand for other sources. `watch` watches both already.
/// returns  what has changed; nullopt after a signal
/// errors: those of FileWatch::watch()
Result<std::optional<std::string>> waitForChange(FileWatch& watch, const std::vector<std::string>& files,
                                                 std::filesystem::file_time_type since,
                                                 const std::vector<std::string>& words,
                                                 const std::vector<std::string>& sources)
{
    for (;;)
    {
        if (const std::vector<std::string> now = currentSources(words); now != sources)
            return std::optional(firstChange(sources, now));
        const std::optional<FileWatch::Change> change = watch.wait();
        if (!change)
            return std::optional<std::string>();
        if (!change->is_in_folder)
            return std::optional(change->path);
        // there may be new folders
        HEARTH_TRY(watch.watch(files, since, sourceFolders(words)));
    }
}

} // namespace

int watch(const std::vector<std::string>& words, const MakeOptions& make_options)
{
    auto files = FileWatch::create();
    if (!files.ok())
        return printError(files.error());
    Verbosity verbosity = Verbosity::normal;
    std::vector<std::string> dependencies;
    for (bool is_first = true;; is_first = false)
    {
        const auto start = std::filesystem::file_time_type::clock::now();
        const std::vector<std::string> sources = currentSources(words);
        std::vector<std::string> settings;
        Result<CookOptions> options = make_options(settings);
        if (!options.ok() && is_first)
            return printError(options.error());
        if (options.ok())
        {
            verbosity = options->verbosity;
            options->force = options->force && is_first;
            dependencies.clear();
            const int exit_code = cook(*options, &dependencies);
            // no edit of a file repairs the command line
            if (exit_code == kInterrupted || (exit_code == kUsage && dependencies.empty()))
                return exit_code;
            dependencies.insert(dependencies.end(), settings.begin(), settings.end());
        }
        else
            printError(options.error());
        if (const Status status = files->watch(dependencies, start, sourceFolders(words)); !status.ok())
            return printError(status.error());
        if (verbosity != Verbosity::quiet)
            printMessage(faint(fmt::format("watching {} files; Ctrl-C ends", files->size())));
        const auto changed = waitForChange(*files, dependencies, start, words, sources);
        if (!changed.ok())
            return printError(changed.error());
        if (!*changed)
            return kInterrupted;
        if (verbosity != Verbosity::quiet)
            printMessage(faint(**changed + " has changed"));
    }
}

} // namespace hearth::command
