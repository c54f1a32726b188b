// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/cache/open_cache.h"
#include "pipelines/command/common_options.h"
#include "pipelines/command/farm_jobs.h"
#include "pipelines/command/verb_plan.h"
#include "pipelines/command/verb_tools.h"
#include "pipelines/command/verbs.h"

#include <CLI/CLI.hpp>

namespace hearth::command
{

namespace
{

// One that a line of a script cannot end in.
std::string partitionFault(const std::string& text)
{
    const bool is_name =
        !text.empty() && text.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
                                                "0123456789_.,-") == std::string::npos;
    return is_name ? "" : "'" + text + "' is no name of a partition";
}

void addPack(CLI::App& verb, std::string& pack)
{
    verb.add_option("--pack", pack, "what the merge writes; by default beside the plan, and named after it");
}

void addSlurm(CLI::App& farm, Work& run)
{
    CLI::App* verb =
        farm.add_subcommand("slurm", "Submit shards to Slurm as an array, and the merge after them");
    struct Options : SlurmVerbOptions
    {
        SettingOptions settings;
        std::string memory = "auto";
    };
    auto options = std::make_shared<Options>();
    addPlanFile(*verb, *options, options->settings);
    addPack(*verb, options->pack);
    verb->add_option("--partition", options->partition, "of the cluster; its own by default")
        ->check(CLI::Validator(partitionFault, ""));
    verb->add_option("--mem-per-shard", options->memory,
                     "as 4G; auto: what its largest cooker is thought to need")
        ->check(CLI::Validator(
            [](const std::string& text) { return text == "auto" ? std::string() : sizeFault(text); }, ""))
        ->capture_default_str();
    verb->add_option("--max-retries", options->retries, "of a shard that ends with code 75")
        ->check(CLI::Range(0u, 1000u))
        ->capture_default_str();
    verb->add_flag("--print", options->prints, "print the script that would submit them");
    verb->footer("Example: hearth farm slurm village.plan.json --pack village.hearth --partition cook");
    verb->callback(
        [options, &run]
        {
            if (options->memory != "auto")
                options->memory_bytes = cache::parseSize(options->memory, "").value();
            run = withConfiguration(options->settings,
                                    [options](const profiles::Configuration& configuration)
                                    {
                                        options->caches = cachesOf(configuration);
                                        return farmSlurm(*options);
                                    });
        });
}

void addNinja(CLI::App& farm, Work& run)
{
    CLI::App* verb = farm.add_subcommand("ninja", "Write a build file for Ninja");
    struct Options : NinjaVerbOptions
    {
        SettingOptions settings;
    };
    auto options = std::make_shared<Options>();
    addPlanFile(*verb, *options, options->settings);
    addPack(*verb, options->pack);
    verb->add_option("-o,--output", options->output, "build file to write")->required();
    verb->add_option("--launcher", options->launcher,
                     "what starts each shard, as \"srun -Q -n1\"; by default they run on this machine");
    verb->footer("Example: hearth farm ninja village.plan.json -o build.ninja --launcher \"srun -Q -n1\"");
    verb->callback(
        [options, &run]
        {
            run = withConfiguration(options->settings,
                                    [options](const profiles::Configuration& configuration)
                                    {
                                        options->caches = cachesOf(configuration);
                                        return farmNinja(*options);
                                    });
        });
}

void addStatus(CLI::App& farm, Work& run)
{
    CLI::App* verb =
        farm.add_subcommand("status", "Say what each shard has left; code 1 where that is not all");
    struct Options : PlanOptions
    {
        SettingOptions settings;
        std::string format = "text";
    };
    auto options = std::make_shared<Options>();
    addPlanFile(*verb, *options, options->settings);
    addFormat(*verb, options->format);
    verb->footer("Example: hearth farm status village.plan.json");
    verb->callback(
        [options, &run]
        {
            run = withConfiguration(options->settings,
                                    [options](const profiles::Configuration& configuration)
                                    {
                                        options->caches = cachesOf(configuration);
                                        return farmStatus(*options, options->format);
                                    });
        });
}

} // namespace

void addFarm(CLI::App& app, Work& run)
{
    CLI::App* verb = app.add_subcommand("farm", "Hand a plan to a batch system");
    verb->require_subcommand(1);
    addSlurm(*verb, run);
    addNinja(*verb, run);
    addStatus(*verb, run);
    verb->footer("Examples:\n"
                 "  hearth farm slurm village.plan.json --partition cook\n"
                 "  hearth farm ninja village.plan.json -o build.ninja --launcher \"srun -Q -n1\"\n"
                 "  hearth farm status village.plan.json");
}

} // namespace hearth::command
