// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/cook/setting_options.h"

#include "pipelines/command/cook/common_options.h"
#include "pipelines/command/shell/verb_tools.h"
#include "pipelines/command/sources/lod_groups.h"
#include "pipelines/command/sources/source_list.h"
#include "pipelines/command/sources/unmatched_rules.h"
#include "pipelines/profiles/cooker_arguments.h"

#include <charconv>

namespace hearth::command
{

namespace
{

using profiles::Given;
using profiles::Kind;
using profiles::Setting;
using profiles::Value;

std::string describe(const Setting& setting)
{
    std::string text(setting.what);
    if (setting.kind != Kind::flag && setting.otherwise != "[]" && !setting.otherwise.empty())
        text += "; by default " + std::string(setting.otherwise);
    return text;
}

std::string fault(const Setting& setting, const std::string& text)
{
    const auto value = profiles::valueOf(setting, {text}, "");
    if (value.ok())
        return "";
    // for lists, the error already quotes the wrong word
    const std::string quoted = "'" + text + "' ";
    return value.error().detail.starts_with(quoted) ? value.error().detail : quoted + value.error().detail;
}

/// Return the long name: "--jobs" of "-j,--jobs".
std::string longName(std::string_view option)
{
    return std::string(option.substr(option.find("--")));
}

uint64_t numberOf(const Value& value)
{
    uint64_t number = 0;
    std::from_chars(value.text.data(), value.text.data() + value.text.size(), number);
    return number;
}

Verbosity verbosityOf(const std::string& word)
{
    return word == "quiet" ? Verbosity::quiet : word == "verbose" ? Verbosity::all : Verbosity::normal;
}

/// Refuse options of visibility or bricks if these are not baked: an option without effect is a mistake.
Status checkInUse(const profiles::Values& values, bool has_visibility, bool has_bricks)
{
    for (const auto& [key, value] : values)
    {
        const std::string_view group = profiles::groupOf(key);
        const bool is_idle = (group == "visibility" && !has_visibility) || (group == "bricks" && !has_bricks);
        if (is_idle && value.text != "false" && value.origin.starts_with("--"))
            return Error{Issue::usage, value.origin, "",
                         "needs --" + std::string(group) + ", or " + std::string(group) +
                             ".enabled in the profile"};
    }
    return success();
}

/// Return the settings of a scope as KEY=VALUE, without import.lods: a request has LODs beside its sources.
farm::Assignments assignmentsOf(const profiles::Values& values, profiles::Scope scope)
{
    farm::Assignments assignments;
    for (const auto& [key, value] : values)
        if (key != profiles::kImportLods &&
            profiles::findSetting(profiles::profileSettings(), key)->scope == scope)
            assignments.push_back(key + "=" + value.text);
    return assignments;
}

} // namespace

void SettingOptions::add(cli::CommandLine& verb, const Setting& setting)
{
    Entry& entry = entries_[setting.key];
    entry.setting = &setting;
    const std::string names(setting.option);
    if (setting.kind == Kind::flag)
        entry.option = verb.addFlag(names, entry.flag, describe(setting));
    else if (setting.kind == Kind::texts)
        entry.option = verb.addOption(names, entry.words, describe(setting)).oneValueEach();
    else
        entry.option = verb.addOption(names, entry.word, describe(setting))
                           .check([&setting](const std::string& text) { return fault(setting, text); });
    if (setting.kind == Kind::choice)
        entry.option->typeName(joined({setting.choices.begin(), setting.choices.end()}, "|"));
    else if (setting.kind != Kind::flag)
        entry.option->typeName(std::string(setting.value_name));
}

void SettingOptions::addOfCommand(cli::CommandLine& verb, const std::vector<std::string>& keys)
{
    for (const std::string& key : keys)
        add(verb, *profiles::findSetting(profiles::commandSettings(), key));
}

void SettingOptions::addLog(cli::CommandLine& verb, const std::string& all)
{
    const cli::Option quiet = verb.addFlag("-q,--quiet", is_quiet_, "print errors only");
    if (!all.empty())
        verb.addFlag("-v,--verbose", is_verbose_, all).excludes(quiet);
}

void SettingOptions::addOfProfiles(cli::CommandLine& verb)
{
    for (const Setting& setting : profiles::profileSettings())
        if (!setting.option.empty())
            add(verb, setting);
    verb.addOption("--set", assignments_,
                   "any setting of a profile, as clusters.influences=4; see hearth config")
        .oneValueEach()
        .typeName("KEY=VALUE");
}

Result<Value> SettingOptions::valueOf(const Entry& entry)
{
    const std::string origin = longName(entry.setting->option);
    if (entry.setting->kind == Kind::flag)
        return Value{"true", origin};
    return profiles::valueOf(
        *entry.setting, entry.setting->kind == Kind::texts ? entry.words : std::vector{entry.word}, origin);
}

Result<Given> SettingOptions::given() const
{
    Given given;
    for (const std::string& assignment : assignments_)
    {
        auto parsed = profiles::parseAssignment(assignment);
        if (!parsed.ok())
            return Error{Issue::usage, parsed.error().file, parsed.error().where, parsed.error().detail};
        given.settings[parsed->first] = std::move(parsed->second);
    }
    for (const auto& [key, entry] : entries_)
    {
        if (entry.option->count() == 0)
            continue;
        auto value = valueOf(entry);
        if (!value.ok())
            return Error{Issue::usage, value.error().file, value.error().where, value.error().detail};
        (entry.setting->scope == profiles::Scope::command ? given.command : given.settings)[key] =
            std::move(value).value();
    }
    if (is_quiet_ || is_verbose_)
        given.command["log"] = is_quiet_ ? Value{"\"quiet\"", "--quiet"} : Value{"\"verbose\"", "--verbose"};
    return given;
}

Result<profiles::Configuration> SettingOptions::configuration() const
{
    HEARTH_ASSIGN_OR_RETURN(Given said, given());
    return loadConfiguration(std::move(said));
}

Work withConfiguration(const SettingOptions& settings,
                       const std::function<int(const profiles::Configuration&)>& work)
{
    return [&settings, work]
    {
        const auto configuration = settings.configuration();
        return configuration.ok() ? work(*configuration) : fail(configuration.error());
    };
}

Effort effortOf(const profiles::Configuration& configuration)
{
    Effort effort;
    if (const Value* jobs = configuration.command("jobs"))
        effort.jobs = static_cast<unsigned>(numberOf(*jobs));
    if (const Value* memory = configuration.command("memory"))
        effort.memory_bytes = numberOf(*memory);
    if (const Value* log = configuration.command("log"))
        effort.verbosity = verbosityOf(profiles::textsOf(*log).front());
    if (const Value* progress = configuration.command("progress"))
        effort.progress = profiles::textsOf(*progress).front();
    return effort;
}

namespace
{

/// Split the files into sources and their LODs. --lod overrides names and rules.
/// errors: usage, profile_value
Status takeSources(const profiles::Configuration& configuration, std::vector<std::string> files,
                   CookOptions& options)
{
    if (!options.lods.empty() && files.size() > 1)
        return Error{Issue::usage, "--lod", "",
                     "needs a cook of one source: which of several it is for is not said"};
    if (!options.lods.empty())
    {
        options.sources = std::move(files);
        options.lods_of_source = {options.lods};
        return success();
    }
    HEARTH_ASSIGN_OR_RETURN(LodGroups groups, groupLods(files, configuration));
    options.sources = std::move(groups.sources);
    options.lods_of_source = std::move(groups.lods_of_source);
    for (const Error& warning : groups.warnings)
        options.setting_warnings.push_back(formatMessage(warning));
    return success();
}

} // namespace

Status configure(const profiles::Configuration& configuration, CookOptions& options)
{
    options.source_words = options.sources;
    HEARTH_ASSIGN_OR_RETURN(const std::vector<std::string> files, sourcesOf(options.sources));
    HEARTH_TRY(takeSources(configuration, files, options));
    bool has_visibility = false;
    for (const std::string& source : options.sources)
    {
        auto told = profiles::toldOfSource(configuration.ofSource(source));
        if (!told.ok() && told.error().file.starts_with("--"))
            return Error{Issue::usage, told.error().file, "", told.error().detail};
        if (!told.ok())
            return told.error();
        has_visibility |= told->visibility.has_value();
        options.settings_of_source.push_back(std::move(told).value());
    }
    const profiles::Values of_pack = configuration.ofPack();
    options.bricks = profiles::toldOfBricks(of_pack);
    HEARTH_TRY(checkInUse(of_pack, has_visibility, options.bricks.has_value()));
    static_cast<Effort&>(options) = effortOf(configuration);
    options.caches = cachesOf(configuration);
    for (const Error& warning : unmatchedRules(configuration, files))
        options.setting_warnings.push_back(formatMessage(warning));
    return success();
}

Result<farm::Request> requestOf(const profiles::Configuration& configuration, CookOptions& options)
{
    // configure() reports errors with the place where the setting was written
    HEARTH_TRY(configure(configuration, options));
    farm::Request request;
    request.sources = options.sources;
    request.lods_of_source = options.lods_of_source;
    for (const std::string& source : request.sources)
        request.settings_of_source.push_back(
            assignmentsOf(configuration.ofSource(source), profiles::Scope::source));
    request.settings_of_pack = assignmentsOf(configuration.ofPack(), profiles::Scope::pack);
    return request;
}

} // namespace hearth::command
