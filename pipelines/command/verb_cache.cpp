// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/cache/open_cache.h"
#include "pipelines/command/cache_verbs.h"
#include "pipelines/command/common_options.h"
#include "pipelines/command/verb_tools.h"
#include "pipelines/command/verbs.h"

#include <CLI/CLI.hpp>

namespace hearth::command
{

void addCache(CLI::App& app, Work& run)
{
    CLI::App* verb = app.add_subcommand("cache", "Look after the cache of results");
    struct Options
    {
        std::string work;
        std::vector<std::string> caches;
        std::string limit;
    };
    auto options = std::make_shared<Options>();
    verb->add_option(
            "WORK", options->work,
            "stat: how full it is; gc: remove what was used least; verify: read every byte and remove what "
            "is damaged")
        ->required()
        ->check(CLI::IsMember({"stat", "gc", "verify"}));
    addCaches(*verb, options->caches);
    verb->add_option("--max-size", options->limit,
                     "gc: how much may stay, as 5G; the cache's limit by default")
        ->check(CLI::Validator(sizeFault, ""));
    verb->footer("Examples:\n"
                 "  hearth cache stat\n"
                 "  hearth cache gc --max-size 5G");
    verb->callback(
        [options, &run]
        {
            run = [options]
            {
                const auto caches = configuredCaches(options->caches);
                if (!caches.ok())
                    return fail(caches.error());
                if (options->work == "stat")
                    return printResult(cacheStat(*caches));
                if (options->work == "gc")
                {
                    std::optional<uint64_t> limit;
                    if (!options->limit.empty())
                        limit = cache::parseSize(options->limit, "").value();
                    return printResult(cacheGc(*caches, limit));
                }
                const auto verified = cacheVerify(*caches);
                if (!verified.ok())
                    return fail(verified.error());
                const int printed = printResult(verified->text);
                return verified->is_whole ? printed : 1;
            };
        });
}

} // namespace hearth::command
