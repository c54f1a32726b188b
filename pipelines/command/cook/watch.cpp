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
std::vector<std::string> sourcesNow(const std::vector<std::string>& words)
{
    const Result<std::vector<std::string>> sources = sourcesOf(words);
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
        if (const std::vector<std::string> now = sourcesNow(words); now != sources)
            return std::optional(firstChange(sources, now));
        const std::optional<FileWatch::Change> change = watch.wait();
        if (!change)
            return std::optional<std::string>();
        if (!change->is_of_folder)
            return std::optional(change->path);
        // there may be new folders
        HEARTH_TRY(watch.watch(files, since, foldersOf(words)));
    }
}

} // namespace

int watch(const std::vector<std::string>& words, const Configure& configure)
{
    auto files = FileWatch::create();
    if (!files.ok())
        return tell(files.error());
    Verbosity verbosity = Verbosity::normal;
    std::vector<std::string> looked_for;
    for (bool is_first = true;; is_first = false)
    {
        const auto start = std::filesystem::file_time_type::clock::now();
        const std::vector<std::string> sources = sourcesNow(words);
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
            // no edit of a file repairs the command line
            if (exit_code == kInterrupted || (exit_code == kUsage && looked_for.empty()))
                return exit_code;
            looked_for.insert(looked_for.end(), settings.begin(), settings.end());
        }
        else
            tell(options.error());
        if (const Status status = files->watch(looked_for, start, foldersOf(words)); !status.ok())
            return tell(status.error());
        if (verbosity != Verbosity::quiet)
            print(faint(fmt::format("watching {} files; Ctrl-C ends", files->size())));
        const auto changed = waitForChange(*files, looked_for, start, words, sources);
        if (!changed.ok())
            return tell(changed.error());
        if (!*changed)
            return kInterrupted;
        if (verbosity != Verbosity::quiet)
            print(faint(**changed + " has changed"));
    }
}

} // namespace hearth::command
