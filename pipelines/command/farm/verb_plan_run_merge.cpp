// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/cook/common_options.h"
#include "pipelines/command/cook/missing_option.h"
#include "pipelines/command/cook/setting_options.h"
#include "pipelines/command/farm/farm_run.h"
#include "pipelines/command/farm/plan_file_options.h"
#include "pipelines/command/shell/messages.h"
#include "pipelines/command/shell/verb_tools.h"
#include "pipelines/command/shell/verbs.h"

#include <charconv>

namespace hearth::command
{

namespace
{

constexpr const char* kMissingList = "list";

/// Add the options of verbs that run cookers.
void addRunLimitOptions(cli::CommandLine& verb, SettingOptions& settings)
{
    settings.addCommandSettings(verb, {"jobs", "memory", "progress"});
    settings.addVerbosityOptions(verb, "print all that cookers say");
}

std::string shardsFault(const std::string& text)
{
    size_t count = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
    const bool is_count =
        error == std::errc() && end == text.data() + text.size() && count >= 1 && count <= farm::kMaxShards;
    return text == "auto" || is_count ? ""
                                      : "'" + text + "' is no number of shards: write auto, or 1 to " +
                                            std::to_string(farm::kMaxShards);
}

int configureAndPlan(MakePlanOptions options, const profiles::Configuration& configuration,
                     const std::vector<std::string>& sources, const std::vector<std::string>& lods)
{
    CookOptions cook;
    cook.sources = sources;
    cook.lods = lods;
    auto request = makeRequest(configuration, cook);
    if (!request.ok())
        return printError(request.error());
    options.request = std::move(request).value();
    options.caches = cook.caches;
    options.quiet = cook.verbosity == Verbosity::quiet;
    for (const std::string& warning : cook.setting_warnings)
        if (!options.quiet)
            printMessage(warning);
    return makePlanFile(options);
}

} // namespace

void addPlanFile(cli::CommandLine& verb, PlanOptions& options, SettingOptions& settings)
{
    verb.addOption("PLAN", options.plan_file, "file that hearth plan has written").required();
    verb.addOption("-C,--directory", options.directory,
                   "folder that relative paths of sources start from; by default where the plan was made");
    settings.addCommandSettings(verb, {"cache"});
}

void addPlan(cli::CommandLine& app, VerbAction& run)
{
    cli::CommandLine& verb =
        app.addSubcommand("plan", "Write down a cook, so that several machines can share it");
    struct Options : MakePlanOptions
    {
        SettingOptions settings;
        std::vector<std::string> sources;
        std::vector<std::string> lods;
        std::string shards = "auto";
        std::string emitted;
    };
    auto options = std::make_shared<Options>();
    verb.addOption("SOURCE", options->sources, "files, folders and patterns, as hearth cook takes them")
        .required();
    verb.addOption("-o,--output", options->output, "plan to write").required();
    verb.addOption("--shards", options->shards,
                   "how many machines may share it; auto: as many as have a minute to do each")
        .check(shardsFault)
        .showDefault();
    verb.addOption("--estimates", options->estimates_file,
                   "what hearth cook --report or hearth merge --report wrote as JSON: the times and memory "
                   "of then, by which shards are made; else sizes of files")
        .typeName("REPORT");
    verb.addOption("--emit", options->emitted, "commands: print a command line for each shard")
        .choices({"commands"});
    verb.addOption("--lod", options->lods,
                   "N=FILE: level of detail N of the source's only mesh, made by hand")
        .oneValueEach();
    options->settings.addCommandSettings(verb, {"profile", "cache"});
    options->settings.addProfileSettings(verb);
    options->settings.addVerbosityOptions(verb, "");
    verb.setFooter("Examples:\n"
                   "  hearth plan *.glb -o village.plan.json --shards 7\n"
                   "  hearth plan *.glb -o village.plan.json --estimates report.json\n"
                   "  hearth plan *.glb -o village.plan.json --emit commands | parallel\n"
                   "Then hearth run for each shard, or hearth farm for all, and hearth merge.");
    verb.setAction(
        [options, &run]
        {
            if (options->shards != "auto")
                options->shard_count = std::stoul(options->shards);
            options->emits_commands = !options->emitted.empty();
            run = withConfiguration(
                options->settings, [options](const profiles::Configuration& configuration)
                { return configureAndPlan(*options, configuration, options->sources, options->lods); });
        });
}

void addRun(cli::CommandLine& app, VerbAction& run)
{
    cli::CommandLine& verb = app.addSubcommand("run", "Cook one shard of a plan, into the cache");
    struct Options : RunOptions
    {
        SettingOptions settings;
        bool is_preparation = false;
    };
    auto options = std::make_shared<Options>();
    addPlanFile(verb, *options, options->settings);
    verb.addOption("--shard", options->shard,
                   "I/N, from 0/N; by default the index that Slurm, Kubernetes, AWS Batch, Grid Engine or "
                   "PBS gives to an array's job");
    verb.addFlag(
        "--prepare", options->is_preparation,
        "cook only what reads no other source: done for all shards first, it spares the shards, which "
        "read the parts of neighbouring sources, cooking these themselves");
    verb.addOption("--launcher", options->launcher,
                   "start it by this command, as \"srun -Q -n1\", and look at what it has left");
    verb.addOption("--record", options->record_file, "write what was done as JSON, when all of it was");
    addRunLimitOptions(verb, options->settings);
    verb.setFooter("Examples:\n"
                   "  hearth run village.plan.json --shard 3/7 --prepare\n"
                   "  hearth run village.plan.json --shard 3/7\n"
                   "It may be run again, and by two machines at once. Code 75: another try may go better.");
    verb.setAction(
        [options, &run]
        {
            run = withConfiguration(options->settings,
                                    [options](const profiles::Configuration& configuration)
                                    {
                                        static_cast<RunLimits&>(*options) = readRunLimits(configuration);
                                        options->caches = cacheSettings(configuration);
                                        if (options->is_preparation)
                                            options->step = farm::Step::prepare;
                                        return runShard(*options);
                                    });
        });
}

void addMerge(cli::CommandLine& app, VerbAction& run)
{
    cli::CommandLine& verb =
        app.addSubcommand("merge", "Make the pack of what the shards of a plan have left");
    struct Options : MergeOptions
    {
        SettingOptions settings;
        std::string missing;
    };
    auto options = std::make_shared<Options>();
    addPlanFile(verb, *options, options->settings);
    verb.addOption("-o,--output", options->output, "pack to write").required();
    addMissingOption(
        verb, options->missing,
        "results that are not there are cooked here, and sources that cannot be cooked are treated "
        "as hearth cook does (error, skip); or they are listed, with code 75: shards that are run "
        "again may make them (list)",
        {kMissingList});
    verb.addOption("--report", options->report_files, "write a report, as hearth cook does; may be repeated")
        .oneValueEach();
    addRunLimitOptions(verb, options->settings);
    verb.setFooter("Example: hearth merge village.plan.json -o village.hearth\n"
                   "Every result is read and hashed, even if the process that made it failed.");
    verb.setAction(
        [options, &run]
        {
            options->lists_missing = options->missing == kMissingList;
            options->skips_missing = options->missing == kMissingSkip;
            run = withConfiguration(options->settings,
                                    [options](const profiles::Configuration& configuration)
                                    {
                                        static_cast<RunLimits&>(*options) = readRunLimits(configuration);
                                        options->caches = cacheSettings(configuration);
                                        return merge(*options);
                                    });
        });
}

} // namespace hearth::command
