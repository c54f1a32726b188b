// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/profiles/configuration.h"

#include "formats/base/nearest_match.h"
#include "formats/base/regular_file.h"
#include "formats/base/text.h"
#include "pipelines/profiles/built_in.h"
#include "pipelines/profiles/command_settings.h"
#include "pipelines/profiles/glob.h"
#include "pipelines/profiles/rules_by_path.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>

namespace hearth::profiles
{

namespace
{

namespace fs = std::filesystem;
using namespace settings;

constexpr const char* kProjectFile = "hearth.toml";
constexpr const char* kOff = "off";

Result<std::string> readSettingsFile(const std::string& path, const char* what)
{
    Result<std::string> text = readFile(path);
    if (text.ok())
        return text;
    Error error = text.error();
    error.detail = fmt::format("{}: {}", what, error.detail);
    return error;
}

/// Return the path of the nearest project file, such as "hearth.toml" or "../../hearth.toml"; empty where
/// there is none.
std::string nearestProjectFile()
{
    std::error_code error;
    const fs::path here = fs::current_path(error);
    if (error)
        return "";
    std::string path = kProjectFile;
    for (fs::path folder = here;; folder = folder.parent_path())
    {
        if (fs::is_regular_file(folder / kProjectFile, error))
            return path;
        if (folder == folder.parent_path())
            return "";
        path = "../" + path;
    }
}

std::string userFile(const Environment& environment)
{
    if (const auto folder = environment("XDG_CONFIG_HOME"))
        return *folder + "/hearth/config.toml";
    const auto home = environment("HOME");
    return home ? *home + "/.config/hearth/config.toml" : "";
}

std::string absoluteFolder(const std::string& path)
{
    std::error_code error;
    const fs::path whole = fs::absolute(path, error).lexically_normal();
    return whole.parent_path().string() + (whole.parent_path() == whole.root_path() ? "" : "/");
}

void overlay(const Values& from, Values& into)
{
    for (const auto& [key, value] : from)
        into[key] = value;
}

bool isFileName(const std::string& profile)
{
    return profile.ends_with(".toml") || profile.find('/') != std::string::npos;
}

} // namespace

std::optional<std::string> processEnvironment(const char* name)
{
    const char* value = std::getenv(name);
    return value == nullptr || *value == '\0' ? std::nullopt : std::optional<std::string>(value);
}

const EnvironmentSwitch* findSetSwitch(const Setting& setting, const Environment& environment)
{
    const auto found =
        std::find_if(setting.switches.begin(), setting.switches.end(),
                     [&](const EnvironmentSwitch& one)
                     { return environment(std::string(one.variable).c_str()).value_or("0") != "0"; });
    return found == setting.switches.end() ? nullptr : &*found;
}

Status Configuration::readFiles(const Environment& environment)
{
    std::string path = command_line_.config_file;
    if (path.empty())
        path = environment("HEARTH_CONFIG").value_or("");
    if (path == kOff)
        return success();
    if (path.empty())
        path = nearestProjectFile();
    if (!path.empty())
    {
        HEARTH_ASSIGN_OR_RETURN(const std::string text,
                                readSettingsFile(path, "the project's file of settings"));
        HEARTH_ASSIGN_OR_RETURN(ConfigFile file, parseConfig(text, path, true));
        project_folder_ = absoluteFolder(path);
        project_file_ = files_.size();
        files_.push_back(std::move(file));
    }
    path = userFile(environment);
    std::error_code error;
    if (path.empty() || !fs::exists(path, error))
        return success();
    HEARTH_ASSIGN_OR_RETURN(const std::string text, readSettingsFile(path, "the user's file of settings"));
    HEARTH_ASSIGN_OR_RETURN(ConfigFile file, parseConfig(text, path, false));
    files_.push_back(std::move(file));
    return success();
}

Status Configuration::readEnvironment(const Environment& environment)
{
    for (const Setting& setting : commandSettings())
    {
        std::string name(setting.variable);
        std::optional<std::string> text = name.empty() ? std::nullopt : environment(name.c_str());
        if (const EnvironmentSwitch* chosen = findSetSwitch(setting, environment))
        {
            name = chosen->variable;
            text = chosen->value;
        }
        if (!text)
            continue;
        const std::vector<std::string> words =
            setting.kind == Kind::texts ? splitText(*text, ';') : std::vector<std::string>{*text};
        HEARTH_ASSIGN_OR_RETURN(environment_[setting.key], parseValue(setting, words, name));
    }
    return success();
}

const Value* Configuration::command(std::string_view key) const
{
    const auto in = [&](const Values& values)
    {
        const auto found = values.find(key);
        return found == values.end() ? nullptr : &found->second;
    };
    if (const Value* value = in(command_line_.command))
        return value;
    if (const Value* value = in(environment_))
        return value;
    for (const ConfigFile& file : files_)
        if (const Value* value = in(file.defaults))
            return value;
    return nullptr;
}

const ConfigFile& Configuration::fileAt(size_t level) const
{
    return level < files_.size() ? files_[level] : builtInProfiles();
}

/// Return the level of the nearest file that has a profile of that name.
std::optional<size_t> Configuration::findLevel(const std::string& name, size_t from) const
{
    for (size_t level = from; level <= files_.size(); ++level)
        for (const Profile& profile : fileAt(level).profiles)
            if (profile.name == name)
                return level;
    return std::nullopt;
}

/// Append the profile and the profiles that it inherits from to the chain, the profile itself first.
Status Configuration::addProfile(const Profile& profile, size_t level, const std::string& file,
                                 std::vector<const Profile*>& chain)
{
    chain.push_back(&profile);
    if (profile.inherits.empty())
        return success();
    // a profile that inherits from its own name overrides the next one of that name
    const std::optional<size_t> found =
        findLevel(profile.inherits, profile.inherits == profile.name ? level + 1 : 0);
    if (!found)
    {
        std::vector<std::string> known;
        for (size_t i = 0; i <= files_.size(); ++i)
            for (const Profile& other : fileAt(i).profiles)
                known.push_back(other.name);
        const std::string nearest = nearestMatch(profile.inherits, known);
        return Error{Issue::profile_unknown, file, profile.place,
                     fmt::format("there is no profile '{}'{}", profile.inherits,
                                 nearest.empty() ? "" : ": did you mean '" + nearest + "'?")};
    }
    for (const Profile& other : fileAt(*found).profiles)
    {
        if (other.name != profile.inherits)
            continue;
        if (std::find(chain.begin(), chain.end(), &other) != chain.end())
            return Error{Issue::profile_circle, file, profile.place, ""};
        return addProfile(other, *found, fileAt(*found).path, chain);
    }
    return success();
}

Status Configuration::chooseProfile()
{
    const Value* chosen = command("profile");
    if (chosen == nullptr)
        return success();
    profile_name_ = valueTexts(*chosen).front();
    // placeholder that inherits from the profile, so that its name is looked up like an inherited one
    Profile wanted;
    wanted.inherits = profile_name_;
    std::string file = chosen->origin;
    if (isFileName(profile_name_))
    {
        // relative paths in a file start from the folder of that file
        std::string path = profile_name_;
        for (const ConfigFile& config : files_)
            if (chosen->origin.starts_with(config.path + ":") && !fs::path(path).is_absolute())
                path = (fs::path(config.path).parent_path() / path).string();
        HEARTH_ASSIGN_OR_RETURN(const std::string text, readSettingsFile(path, "the profile"));
        HEARTH_ASSIGN_OR_RETURN(wanted, parseProfileFile(text, path));
        file = path;
    }
    profile_file_ = std::move(wanted);
    std::vector<const Profile*> chain;
    HEARTH_TRY(addProfile(*profile_file_, 0, file, chain));
    for (auto profile = chain.rbegin(); profile != chain.rend(); ++profile)
        overlay((*profile)->values, profile_values_);
    return success();
}

Result<Configuration> Configuration::load(CommandLineValues given, const Environment& environment)
{
    Configuration configuration;
    configuration.command_line_ = std::move(given);
    HEARTH_TRY(configuration.readFiles(environment));
    HEARTH_TRY(configuration.readEnvironment(environment));
    HEARTH_TRY(configuration.chooseProfile());
    return configuration;
}

const ConfigFile* Configuration::projectFile() const
{
    return project_file_ ? &files_[*project_file_] : nullptr;
}

std::string Configuration::pathInProject(const std::string& source) const
{
    std::error_code error;
    const std::string path = fs::absolute(source, error).lexically_normal().string();
    return path.starts_with(project_folder_) ? path.substr(project_folder_.size()) : "";
}

std::string Configuration::pathForRules(const std::string& source) const
{
    return project_file_ ? pathInProject(source) : fs::path(source).lexically_normal().string();
}

Values Configuration::valuesOfSource(const std::string& source) const
{
    Values values = profile_values_;
    if (project_file_)
    {
        const std::string path = pathInProject(source);
        for (const Rule& rule : files_[*project_file_].rules)
            if (!path.empty() && matchesPath(rule.match, path) && rule.appliesTo(profile_name_))
                overlay(rule.values, values);
    }
    overlay(command_line_.settings, values);
    selectRulesByPath(pathForRules(source), values);
    return values;
}

Values Configuration::valuesOfPack() const
{
    Values values = profile_values_;
    overlay(command_line_.settings, values);
    return values;
}

} // namespace hearth::profiles
