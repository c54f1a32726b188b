// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/cache_verbs.h"
#include "pipelines/command/common_options.h"
#include "pipelines/command/setting_options.h"
#include "pipelines/command/verb_tools.h"
#include "pipelines/command/verbs.h"

#include <CLI/CLI.hpp>

namespace hearth::command
{

namespace
{

/// limit  of --max-size; empty: none
int lookAfter(const std::vector<cache::LevelSpec>& caches, const std::string& work, const std::string& limit)
{
    if (work == "stat")
        return printResult(cacheStat(caches));
    if (work == "gc")
    {
        std::optional<uint64_t> bytes;
        if (!limit.empty())
            bytes = cache::parseSize(limit, "").value();
        return printResult(cacheGc(caches, bytes));
    }
    const CacheVerification verified = cacheVerify(caches);
    const int printed = printResult(verified.text);
    return verified.is_whole ? printed : 1;
}

} // namespace

void addCache(CLI::App& app, Work& run)
{
    CLI::App* verb = app.add_subcommand("cache", "Look after the cache of results");
    struct Options
    {
        std::string work;
        SettingOptions settings;
        std::string limit;
    };
    auto options = std::make_shared<Options>();
    verb->add_option(
            "WORK", options->work,
            "stat: how full it is; gc: remove what was used least; verify: read every byte and remove what "
            "is damaged")
        ->required()
        ->check(CLI::IsMember({"stat", "gc", "verify"}));
    options->settings.addOfCommand(*verb, {"cache"});
    verb->add_option("--max-size", options->limit,
                     "gc: how much may stay, as 5G; the cache's limit by default")
        ->check(CLI::Validator(sizeFault, ""));
    verb->footer("Examples:\n"
                 "  hearth cache stat\n"
                 "  hearth cache gc --max-size 5G");
    verb->callback(
        [options, &run]
        {
            run = withConfiguration(options->settings,
                                    [options](const profiles::Configuration& configuration)
                                    {
                                        const auto caches = levelsOf(configuration);
                                        return caches.ok() ? lookAfter(*caches, options->work, options->limit)
                                                           : fail(caches.error());
                                    });
        });
}

} // namespace hearth::command
