// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/cache/cache_spec.h"
#include "pipelines/command/cook/common_options.h"
#include "pipelines/command/cook/missing_option.h"
#include "pipelines/command/farm/farm_jobs.h"
#include "pipelines/command/farm/plan_file_options.h"
#include "pipelines/command/shell/verb_tools.h"
#include "pipelines/command/shell/verbs.h"

namespace hearth::command
{

namespace
{

// Return the fault of a partition's name; empty if a line of a script can hold it.
std::string partitionFault(const std::string& text)
{
    const bool is_name =
        !text.empty() && text.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
                                                "0123456789_.,-") == std::string::npos;
    return is_name ? "" : "'" + text + "' is no name of a partition";
}

void addMergeOptions(cli::CommandLine& verb, FarmVerbOptions& options)
{
    verb.addOption("--pack", options.pack,
                   "what the merge writes; by default beside the plan, and named after it");
    addMissingOption(verb, options.missing,
                     "of the merge: where a source cannot be cooked there is no pack, or a pack without it");
}

void addSlurm(cli::CommandLine& farm, VerbAction& run)
{
    cli::CommandLine& verb =
        farm.addSubcommand("slurm", "Submit shards to Slurm as an array, and the merge after them");
    struct Options : SlurmVerbOptions
    {
        SettingOptions settings;
        std::string memory = "auto";
    };
    auto options = std::make_shared<Options>();
    addPlanFile(verb, *options, options->settings);
    addMergeOptions(verb, *options);
    verb.addOption("--partition", options->partition, "of the cluster; its own by default")
        .check(partitionFault);
    verb.addOption("--mem-per-shard", options->memory,
                   "as 4G; auto: what its largest cooker is thought to need")
        .check([](const std::string& text) { return text == "auto" ? std::string() : sizeFault(text); })
        .showDefault();
    verb.addOption("--max-retries", options->retries, "of a shard that ends with code 75")
        .range(0u, 1000u)
        .showDefault();
    verb.addFlag("--print", options->prints, "print the script that would submit them");
    verb.setFooter("Example: hearth farm slurm village.plan.json --pack village.hearth --partition cook");
    verb.setAction(
        [options, &run]
        {
            if (options->memory != "auto")
                options->memory_bytes = cache::parseSize(options->memory, "").value();
            run = withConfiguration(options->settings,
                                    [options](const profiles::Configuration& configuration)
                                    {
                                        options->caches = cacheSettings(configuration);
                                        return submitToSlurm(*options);
                                    });
        });
}

void addNinja(cli::CommandLine& farm, VerbAction& run)
{
    cli::CommandLine& verb = farm.addSubcommand("ninja", "Write a build file for Ninja");
    struct Options : NinjaVerbOptions
    {
        SettingOptions settings;
    };
    auto options = std::make_shared<Options>();
    addPlanFile(verb, *options, options->settings);
    addMergeOptions(verb, *options);
    verb.addOption("-o,--output", options->output, "build file to write").required();
    verb.addOption("--launcher", options->launcher,
                   "what starts each shard, as \"srun -Q -n1\"; by default they run on this machine");
    verb.setFooter("Example: hearth farm ninja village.plan.json -o build.ninja --launcher \"srun -Q -n1\"");
    verb.setAction(
        [options, &run]
        {
            run = withConfiguration(options->settings,
                                    [options](const profiles::Configuration& configuration)
                                    {
                                        options->caches = cacheSettings(configuration);
                                        return writeNinjaFile(*options);
                                    });
        });
}

void addStatus(cli::CommandLine& farm, VerbAction& run)
{
    cli::CommandLine& verb =
        farm.addSubcommand("status", "Say what each shard has left; code 1 where that is not all");
    struct Options : PlanOptions
    {
        SettingOptions settings;
        std::string format = "text";
    };
    auto options = std::make_shared<Options>();
    addPlanFile(verb, *options, options->settings);
    addFormat(verb, options->format);
    verb.setFooter("Example: hearth farm status village.plan.json");
    verb.setAction(
        [options, &run]
        {
            run = withConfiguration(options->settings,
                                    [options](const profiles::Configuration& configuration)
                                    {
                                        options->caches = cacheSettings(configuration);
                                        return printFarmStatus(*options, options->format);
                                    });
        });
}

} // namespace

void addFarm(cli::CommandLine& app, VerbAction& run)
{
    cli::CommandLine& verb = app.addSubcommand("farm", "Hand a plan to a batch system");
    verb.requireSubcommand();
    addSlurm(verb, run);
    addNinja(verb, run);
    addStatus(verb, run);
    verb.setFooter("Examples:\n"
                   "  hearth farm slurm village.plan.json --partition cook\n"
                   "  hearth farm ninja village.plan.json -o build.ninja --launcher \"srun -Q -n1\"\n"
                   "  hearth farm status village.plan.json");
}

} // namespace hearth::command
