// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/setting_options.h"
#include "pipelines/command/unmatched_rules.h"
#include "pipelines/command/verb_tools.h"
#include "pipelines/command/verbs.h"
#include "pipelines/command/watch.h"

#include <CLI/CLI.hpp>

namespace hearth::command
{

namespace
{

/// "W1302,W1303"; none of "all".
std::vector<std::string> codesOf(const std::string& text)
{
    return text == "all" ? std::vector<std::string>() : CLI::detail::split(text, ',');
}

std::string codesFault(const std::string& text)
{
    std::vector<std::string> known;
    for (const IssueInfo& info : allIssues())
        if (info.kind == IssueClass::warning)
            known.push_back("W" + std::to_string(static_cast<unsigned>(info.issue)));
    for (const std::string& code : codesOf(text))
        if (std::find(known.begin(), known.end(), code) == known.end())
            return "'" + code + "' is no warning: they are " + CLI::detail::join(known, ", ");
    return "";
}

/// The options with what the configuration adds.
/// files    gets those of the configuration
Result<CookOptions> configured(const CookOptions& options, const SettingOptions& settings,
                               std::vector<std::string>& files)
{
    HEARTH_ASSIGN_OR_RETURN(const profiles::Configuration configuration, settings.configuration());
    for (const profiles::ConfigFile& file : configuration.files())
        files.push_back(file.path);
    CookOptions all = options;
    HEARTH_TRY(configure(configuration, all));
    for (const Error& warning : unmatchedRules(configuration, all.sources))
        all.setting_warnings.push_back(formatMessage(warning));
    return all;
}

int cookConfigured(const CookOptions& options, const SettingOptions& settings)
{
    std::vector<std::string> files;
    const Result<CookOptions> all = configured(options, settings, files);
    return all.ok() ? cook(*all) : fail(all.error());
}

int watchConfigured(const CookOptions& options, const SettingOptions& settings)
{
    return watch(options.sources,
                 [&](std::vector<std::string>& files) { return configured(options, settings, files); });
}

} // namespace

void addCook(CLI::App& app, Work& run)
{
    CLI::App* verb = app.add_subcommand("cook", "Turn sources into a pack");
    struct Options : CookOptions
    {
        SettingOptions settings;
        bool watches = false;
        std::string fatal;
    };
    auto options = std::make_shared<Options>();
    verb->add_option("SOURCE", options->sources,
                     "glTF, GLB, OBJ, PLY, STL, OFF, Draco or image files; a folder: all models in it; "
                     "a pattern in quotes, as 'props/**/*.glb'")
        ->required();
    verb->add_option("-o,--output", options->output, "pack to write")->required();
    verb->add_option("--lod", options->lods,
                     "N=FILE: level of detail N of the source's only mesh, made by hand")
        ->allow_extra_args(false);
    options->settings.addOfCommand(*verb, {"profile", "jobs", "memory", "cache", "progress"});
    options->settings.addOfProfiles(*verb);
    verb->add_option(
            "--report", options->report_files,
            "write what became of it: FILE.html is a page with pictures, .xml JUnit's, .csv a table, "
            "all else JSON; may be repeated")
        ->allow_extra_args(false);
    verb->add_option("--events", options->events_file,
                     "write what happens while it happens, a JSON object a line");
    verb->add_flag("--warnings-as-errors{all}", options->fatal,
                   "warnings keep the pack from being written; =W1302,W1303: these alone")
        ->check(CLI::Validator(codesFault, ""));
    auto* fail_fast =
        verb->add_flag("--fail-fast", options->fail_fast, "end at the first failure, not after all sources");
    verb->add_flag("-k,--keep-going")
        ->description("cook the other sources after a failure: the default")
        ->excludes(fail_fast);
    auto* no_cache = verb->add_flag("--no-cache", options->no_cache, "run every cooker and keep nothing");
    verb->add_flag("-f,--force", options->force, "run every cooker, whatever the cache has")
        ->excludes(no_cache);
    auto* depfile = verb->add_option("--depfile", options->depfile,
                                     "write what was read, textures that were found too, for make or ninja");
    auto* dry_run = verb->add_flag("-n,--dry-run", options->dry_run, "only say what would run, and why")
                        ->excludes(depfile);
    verb->add_option("--format", options->dry_run_format, "of --dry-run; json: the whole plan")
        ->check(CLI::IsMember({"text", "json"}))
        ->needs(dry_run);
    verb->add_flag(
            "--watch", options->watches,
            "cook, and again whenever a file changes that it reads or looks for, or a source comes or goes; "
            "Ctrl-C ends it")
        ->excludes(dry_run);
    verb->add_flag("--explain", options->explain, "say why each cooker runs");
    options->settings.addLog(*verb, "print the command line of every stage");
    verb->footer("Examples:\n"
                 "  hearth cook house.glb tree.glb -o village.hearth\n"
                 "  hearth cook assets/ --profile mobile-low -o village.hearth\n"
                 "Several sources become one pack, their scenes side by side.\n"
                 "A second cook runs only the cookers whose input has changed.");
    verb->callback(
        [options, &run]
        {
            if (!options->fatal.empty())
                options->fatal_warnings = codesOf(options->fatal);
            run = [options]
            {
                return options->watches ? watchConfigured(*options, options->settings)
                                        : cookConfigured(*options, options->settings);
            };
        });
}

} // namespace hearth::command
