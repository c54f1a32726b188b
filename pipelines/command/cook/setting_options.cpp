// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/cook/setting_options.h"

#include "pipelines/command/cook/common_options.h"
#include "pipelines/command/shell/verb_tools.h"
#include "pipelines/command/sources/lod_groups.h"
#include "pipelines/command/sources/source_list.h"
#include "pipelines/command/sources/unmatched_rules.h"
#include "pipelines/cookers/registry.h"
#include "pipelines/profiles/assignment.h"
#include "pipelines/profiles/command_settings.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>

namespace hearth::command
{

namespace
{

using profiles::CommandLineValues;
using settings::Kind;
using settings::Setting;
using settings::Value;

std::string describe(const Setting& setting)
{
    std::string text(setting.what);
    if (setting.kind != Kind::flag && setting.default_text != "[]" && !setting.default_text.empty())
        text += "; by default " + std::string(setting.default_text);
    return text;
}

std::string valueFault(const Setting& setting, const std::string& text)
{
    const auto value = settings::parseValue(setting, {text}, "");
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

uint64_t parseNumber(const Value& value)
{
    uint64_t number = 0;
    std::from_chars(value.text.data(), value.text.data() + value.text.size(), number);
    return number;
}

Verbosity parseVerbosity(const std::string& word)
{
    return word == "quiet" ? Verbosity::quiet : word == "verbose" ? Verbosity::all : Verbosity::normal;
}

/// Refuse options of cookers that do not run: an option without effect is a mistake.
Status checkOptionsHaveEffect(const graph::CookSettings& settings)
{
    for (const cookers::Cooker& cooker : cookers::allCookers())
    {
        if (cookers::isEnabled(cooker, settings.values_of_pack, settings.values_of_source))
            continue;
        for (const Setting& setting : cooker.settings)
        {
            const Value* value = settings::findValue(settings.values_of_pack, setting.key);
            if (value != nullptr && setting.key != cooker.switched_by && value->text != "false" &&
                value->origin.starts_with("--"))
                return Error{
                    Issue::usage, value->origin, "",
                    cooker.runsFor == nullptr
                        ? fmt::format("has no effect: {} is off", cooker.switched_by)
                        : fmt::format("has no effect: {} of no source needs it", cooker.switched_by)};
        }
    }
    return success();
}

/// Return the settings of a scope as KEY=VALUE, without import.lods: a request has LODs beside its sources.
farm::Assignments makeAssignments(const settings::Values& values, settings::Scope scope)
{
    farm::Assignments assignments;
    for (const auto& [key, value] : values)
        if (key != cookers::kImportLods &&
            settings::findSetting(cookers::profileSettings(), key)->scope == scope)
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
    else if (!setting.bare_choice.empty())
        entry.option =
            verb.addOptionalChoice(names, entry.word, {setting.choices.begin(), setting.choices.end()},
                                   std::string(setting.bare_choice), describe(setting));
    else if (setting.kind == Kind::texts)
        entry.option = verb.addOption(names, entry.words, describe(setting)).oneValueEach();
    else
        entry.option = verb.addOption(names, entry.word, describe(setting))
                           .check([&setting](const std::string& text) { return valueFault(setting, text); });
    if (setting.kind == Kind::choice && setting.bare_choice.empty())
        entry.option->typeName(joinWords({setting.choices.begin(), setting.choices.end()}, "|"));
    else if (setting.kind != Kind::flag && setting.kind != Kind::choice)
        entry.option->typeName(std::string(setting.value_name));
}

void SettingOptions::addCommandSettings(cli::CommandLine& verb, const std::vector<std::string>& keys)
{
    for (const std::string& key : keys)
        add(verb, *settings::findSetting(profiles::commandSettings(), key));
}

void SettingOptions::addVerbosityOptions(cli::CommandLine& verb, const std::string& all)
{
    const cli::Option quiet = verb.addFlag("-q,--quiet", is_quiet_, "print errors only");
    if (!all.empty())
        verb.addFlag("-v,--verbose", is_verbose_, all).excludes(quiet);
}

void SettingOptions::addProfileSettings(cli::CommandLine& verb)
{
    for (const Setting& setting : cookers::profileSettings())
        if (!setting.option.empty())
            add(verb, setting);
    verb.addOption("--set", assignments_,
                   "any setting of a profile, as clusters.influences=4; see hearth config")
        .oneValueEach()
        .typeName("KEY=VALUE");
}

Result<Value> SettingOptions::getValue(const Entry& entry)
{
    const std::string origin = longName(entry.setting->option);
    if (entry.setting->kind == Kind::flag)
        return Value{"true", origin};
    return settings::parseValue(
        *entry.setting, entry.setting->kind == Kind::texts ? entry.words : std::vector{entry.word}, origin);
}

Result<CommandLineValues> SettingOptions::overrides() const
{
    CommandLineValues overrides;
    for (const std::string& assignment : assignments_)
    {
        auto parsed = profiles::parseAssignment(assignment);
        if (!parsed.ok())
            return Error{Issue::usage, parsed.error().file, parsed.error().where, parsed.error().detail};
        overrides.settings[parsed->first] = std::move(parsed->second);
    }
    for (const auto& [key, entry] : entries_)
    {
        if (entry.option->count() == 0)
            continue;
        auto value = getValue(entry);
        if (!value.ok())
            return Error{Issue::usage, value.error().file, value.error().where, value.error().detail};
        (entry.setting->scope == settings::Scope::command ? overrides.command : overrides.settings)[key] =
            std::move(value).value();
    }
    if (is_quiet_ || is_verbose_)
        overrides.command["log"] =
            is_quiet_ ? Value{"\"quiet\"", "--quiet"} : Value{"\"verbose\"", "--verbose"};
    return overrides;
}

Result<profiles::Configuration> SettingOptions::configuration() const
{
    HEARTH_ASSIGN_OR_RETURN(CommandLineValues values, overrides());
    return loadConfiguration(std::move(values));
}

VerbAction withConfiguration(const SettingOptions& settings,
                             const std::function<int(const profiles::Configuration&)>& work)
{
    return [&settings, work]
    {
        const auto configuration = settings.configuration();
        return configuration.ok() ? work(*configuration) : printError(configuration.error());
    };
}

RunLimits readRunLimits(const profiles::Configuration& configuration)
{
    RunLimits limits;
    if (const Value* jobs = configuration.command("jobs"))
        limits.jobs = static_cast<unsigned>(parseNumber(*jobs));
    if (const Value* memory = configuration.command("memory"))
        limits.memory_bytes = parseNumber(*memory);
    if (const Value* log = configuration.command("log"))
        limits.verbosity = parseVerbosity(settings::valueTexts(*log).front());
    if (const Value* progress = configuration.command("progress"))
        limits.progress = settings::valueTexts(*progress).front();
    return limits;
}

namespace
{

/// Split the files into sources and their LODs. --lod overrides names and rules.
/// errors: usage, profile_value
Status splitSources(const profiles::Configuration& configuration, std::vector<std::string> files,
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

/// Refuse --proxy for several sources: its files are in the folder of one.
Status checkProxyFiles(const CookOptions& options)
{
    const auto is_typed = [](const settings::Values& values)
    {
        const Value* const files = settings::findValue(values, cookers::kImportProxies);
        return files != nullptr && files->origin.starts_with("--proxy");
    };
    if (options.sources.size() > 1 && std::ranges::any_of(options.values_of_source, is_typed))
        return Error{Issue::usage, "--proxy", "",
                     "needs a cook of one source: which of several it is for is not said; a rule of "
                     "hearth.toml with import.proxies says it"};
    return success();
}

} // namespace

Status applyConfiguration(const profiles::Configuration& configuration, CookOptions& options)
{
    options.source_words = options.sources;
    HEARTH_ASSIGN_OR_RETURN(const std::vector<std::string> files, expandSources(options.sources));
    HEARTH_TRY(splitSources(configuration, files, options));
    for (const std::string& source : options.sources)
    {
        settings::Values values = configuration.valuesOfSource(source);
        const Status checked = cookers::checkSourceSettings(values);
        if (!checked.ok() && checked.error().file.starts_with("--"))
            return Error{Issue::usage, checked.error().file, "", checked.error().detail};
        HEARTH_TRY(checked);
        options.values_of_source.push_back(std::move(values));
    }
    HEARTH_TRY(checkProxyFiles(options));
    options.values_of_pack = configuration.valuesOfPack();
    HEARTH_TRY(checkOptionsHaveEffect(options));
    static_cast<RunLimits&>(options) = readRunLimits(configuration);
    options.caches = cacheSettings(configuration);
    for (const Error& warning : findUnmatchedRules(configuration, files))
        options.setting_warnings.push_back(formatMessage(warning));
    return success();
}

Result<farm::Request> makeRequest(const profiles::Configuration& configuration, CookOptions& options)
{
    // applyConfiguration() reports errors with the place where the setting was written
    HEARTH_TRY(applyConfiguration(configuration, options));
    farm::Request request;
    request.sources = options.sources;
    request.lods_of_source = options.lods_of_source;
    for (const std::string& source : request.sources)
        request.settings_of_source.push_back(
            makeAssignments(configuration.valuesOfSource(source), settings::Scope::source));
    request.settings_of_pack = makeAssignments(configuration.valuesOfPack(), settings::Scope::pack);
    return request;
}

} // namespace hearth::command
