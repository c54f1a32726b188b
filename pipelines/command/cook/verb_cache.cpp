// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/cook/cache_maintenance.h"
#include "pipelines/command/cook/common_options.h"
#include "pipelines/command/cook/setting_options.h"
#include "pipelines/command/shell/verb_tools.h"
#include "pipelines/command/shell/verbs.h"

namespace hearth::command
{

namespace
{

/// Run hearth cache stat, gc or verify.
/// limit  value of --max-size; empty: none
int maintainCaches(const std::vector<cache::CacheSpec>& caches, const std::string& work,
                   const std::string& limit)
{
    if (work == "stat")
        return printResult(cacheStatistics(caches));
    if (work == "gc")
    {
        std::optional<uint64_t> bytes;
        if (!limit.empty())
            bytes = cache::parseSize(limit, "").value();
        return printResult(collectCacheGarbage(caches, bytes));
    }
    const CacheVerification verified = verifyCaches(caches);
    const int printed = printResult(verified.text);
    return verified.is_intact ? printed : 1;
}

} // namespace

void addCache(cli::CommandLine& app, VerbAction& run)
{
    cli::CommandLine& verb = app.addSubcommand("cache", "Look after the cache of results");
    struct Options
    {
        std::string work;
        SettingOptions settings;
        std::string limit;
    };
    auto options = std::make_shared<Options>();
    verb.addOption(
            "WORK", options->work,
            "stat: how full it is; gc: remove what was used least; verify: read every byte and remove what "
            "is damaged")
        .required()
        .choices({"stat", "gc", "verify"});
    options->settings.addCommandSettings(verb, {"cache"});
    verb.addOption("--max-size", options->limit, "gc: how much may stay, as 5G; the cache's limit by default")
        .check(sizeFault);
    verb.setFooter("Examples:\n"
                   "  hearth cache stat\n"
                   "  hearth cache gc --max-size 5G");
    verb.setAction(
        [options, &run]
        {
            run = withConfiguration(options->settings,
                                    [options](const profiles::Configuration& configuration)
                                    {
                                        const auto caches = readCacheSpecs(configuration);
                                        return caches.ok()
                                                   ? maintainCaches(*caches, options->work, options->limit)
                                                   : printError(caches.error());
                                    });
        });
}

} // namespace hearth::command
