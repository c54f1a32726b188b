// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/cook/missing_option.h"
#include "pipelines/command/cook/setting_options.h"
#include "pipelines/command/cook/watch.h"
#include "pipelines/command/shell/verb_tools.h"
#include "pipelines/command/shell/verbs.h"

#include <algorithm>
#include <sstream>

namespace hearth::command
{

namespace
{

/// Split "W1302,W1303" into codes; "all" has none.
std::vector<std::string> parseCodes(const std::string& text)
{
    std::vector<std::string> codes;
    std::istringstream list(text);
    for (std::string code; text != "all" && std::getline(list, code, ',');)
        codes.push_back(code);
    return codes;
}

std::string codesFault(const std::string& text)
{
    std::vector<std::string> known;
    for (const IssueInfo& info : allIssues())
        if (info.kind == IssueClass::warning)
            known.push_back("W" + std::to_string(static_cast<unsigned>(info.issue)));
    for (const std::string& code : parseCodes(text))
        if (std::find(known.begin(), known.end(), code) == known.end())
            return "'" + code + "' is no warning: they are " + joinWords(known, ", ");
    return "";
}

/// Return the options with what the configuration adds.
/// files    receives the paths of the configuration files
Result<CookOptions> makeConfiguredOptions(const CookOptions& options, const SettingOptions& settings,
                                          std::vector<std::string>& files)
{
    HEARTH_ASSIGN_OR_RETURN(const profiles::Configuration configuration, settings.configuration());
    for (const profiles::ConfigFile& file : configuration.files())
        files.push_back(file.path);
    CookOptions all = options;
    HEARTH_TRY(applyConfiguration(configuration, all));
    return all;
}

int configureAndCook(const CookOptions& options, const SettingOptions& settings)
{
    std::vector<std::string> files;
    const Result<CookOptions> all = makeConfiguredOptions(options, settings, files);
    return all.ok() ? cook(*all) : printError(all.error());
}

int configureAndWatch(const CookOptions& options, const SettingOptions& settings)
{
    return watch(options.sources, [&](std::vector<std::string>& files)
                 { return makeConfiguredOptions(options, settings, files); });
}

} // namespace

void addCook(cli::CommandLine& app, VerbAction& run)
{
    cli::CommandLine& verb = app.addSubcommand("cook", "Turn sources into a pack");
    struct Options : CookOptions
    {
        SettingOptions settings;
        bool watches = false;
        std::string missing;
        std::string fatal;
    };
    auto options = std::make_shared<Options>();
    verb.addOption("SOURCE", options->sources,
                   "glTF, GLB, OBJ, PLY, STL, OFF, Draco or image files; a folder: all models in it; "
                   "a pattern in quotes, as 'props/**/*.glb'")
        .required();
    verb.addOption("-o,--output", options->output, "pack to write").required();
    verb.addOption("--lod", options->lods,
                   "N=FILE: level of detail N of the source's only mesh, made by hand")
        .oneValueEach();
    options->settings.addCommandSettings(verb, {"profile", "jobs", "memory", "cache", "progress"});
    options->settings.addProfileSettings(verb);
    verb.addOption("--report", options->report_files,
                   "write a report: FILE.html is a page with images, .xml JUnit's, .csv a table, "
                   "all else JSON; may be repeated")
        .oneValueEach();
    verb.addOption("--events", options->events_file,
                   "write what happens while it happens, a JSON object a line");
    verb.addFlag("--warnings-as-errors{all}", options->fatal,
                 "warnings keep the pack from being written; =W1302,W1303: these alone")
        .check(codesFault);
    const cli::Option fail_fast =
        verb.addFlag("--fail-fast", options->fail_fast, "end at the first failure, not after all sources");
    verb.addFlag("-k,--keep-going", "cook the other sources after a failure: the default")
        .excludes(fail_fast);
    addMissingOption(
        verb, options->missing,
        "where a source cannot be cooked there is no pack (error), or the pack is made without it, "
        "lists it, and the exit code is 1 (skip)");
    verb.setCheck(
        [options]
        {
            return options->fail_fast && options->missing == kMissingSkip
                       ? std::string("--fail-fast: ends at the first failure, where --missing skip goes on")
                       : std::string();
        });
    const cli::Option no_cache =
        verb.addFlag("--no-cache", options->no_cache, "run every cooker and keep nothing");
    verb.addFlag("-f,--force", options->force, "run every cooker, whatever the cache has").excludes(no_cache);
    const cli::Option depfile =
        verb.addOption("--depfile", options->depfile,
                       "write what was read, textures that were found too, for make or ninja");
    const cli::Option dry_run =
        verb.addFlag("-n,--dry-run", options->dry_run, "only say what would run, and why").excludes(depfile);
    verb.addOption("--format", options->dry_run_format, "of --dry-run; json: the whole plan")
        .choices({"text", "json"})
        .needs(dry_run);
    verb.addFlag("--check", options->dry_run_checks,
                 "of --dry-run: end with code 1 where something would run")
        .needs(dry_run);
    verb.addFlag(
            "--watch", options->watches,
            "cook, and again whenever a file changes that it reads or looks for, or a source comes or goes; "
            "Ctrl-C ends it")
        .excludes(dry_run);
    verb.addFlag("--explain", options->explain, "say why each cooker runs");
    options->settings.addVerbosityOptions(verb, "print the command line of every stage");
    verb.setFooter("Examples:\n"
                   "  hearth cook house.glb tree.glb -o village.hearth\n"
                   "  hearth cook assets/ --profile mobile-low -o village.hearth\n"
                   "Several sources become one pack, their scenes side by side.\n"
                   "A second cook runs only the cookers whose input has changed.");
    verb.setAction(
        [options, &run]
        {
            options->skips_missing = options->missing == kMissingSkip;
            if (!options->fatal.empty())
                options->fatal_warnings = parseCodes(options->fatal);
            run = [options]
            {
                return options->watches ? configureAndWatch(*options, options->settings)
                                        : configureAndCook(*options, options->settings);
            };
        });
}

} // namespace hearth::command
