// Resolves the settings of a cook from the command line, the environment, the project's file, the user's file
// and the built-in profiles.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/profiles/config_file.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace hearth::profiles
{

/// Function that reads a variable of the environment; nullopt where it is not set, or empty.
using Environment = std::function<std::optional<std::string>(const char* name)>;
std::optional<std::string> processEnvironment(const char* name);

/// Return the first of a setting's switches that is set; nullptr where none is.
const settings::EnvironmentSwitch* findSetSwitch(const settings::Setting& setting,
                                                 const Environment& environment = processEnvironment);

/// Settings of the command line.
struct CommandLineValues
{
    /// --config: path of a project's file, or "off" for no file at all; empty: see Configuration::load
    std::string config_file;
    settings::Values command;  ///< values of commandSettings()
    settings::Values settings; ///< values of cookers::profileSettings(), for all sources
};

class Configuration
{
public:
    /// Load the configuration. The project's file is --config, else HEARTH_CONFIG, else hearth.toml in the
    /// working folder or the nearest one above; the user's is hearth/config.toml in XDG_CONFIG_HOME or
    /// ~/.config. "off" for --config or HEARTH_CONFIG: neither file is read. Then choose the profile: the one
    /// of the command line, of HEARTH_PROFILE, of [defaults] in the project's file, in the user's file, or
    /// none.
    ///
    /// errors  input_missing, profile_syntax, profile_key, profile_value, profile_unknown, profile_circle
    static Result<Configuration> load(CommandLineValues given,
                                      const Environment& environment = processEnvironment);

    /// Return the value of a setting of commandSettings(); nullptr where it is not set.
    const settings::Value* command(std::string_view key) const;

    /// Return all values that are set for a source: its profile with inherited values, then the matching
    /// rules, later ones over earlier ones, then the command line; lists of rules as selectRulesByPath.
    /// valuesOfPack: the same without rules, for settings of the pack.
    ///
    /// source  as the user typed it; rules match its path from the folder of the project's file
    settings::Values valuesOfSource(const std::string& source) const;
    settings::Values valuesOfPack() const;

    /// Return the name of the chosen profile; empty: none.
    const std::string& profileName() const { return profile_name_; }
    /// Return the files that were read, nearest first.
    const std::vector<ConfigFile>& files() const { return files_; }
    /// Return the project's file, the only one that may have rules; nullptr where there is none.
    const ConfigFile* projectFile() const;
    /// Return the folder of the project's file, absolute, with a slash at its end; empty where there is none.
    const std::string& projectFolder() const { return project_folder_; }
    /// Return the path of a source from the project folder, by which rules match it; empty where it is not
    /// below that folder.
    std::string pathInProject(const std::string& source) const;
    /// Return the path by which rules match a source, also where no project has a file: its path as typed.
    std::string pathForRules(const std::string& source) const;

private:
    Status readFiles(const Environment& environment);
    Status readEnvironment(const Environment& environment);
    Status chooseProfile();
    Status addProfile(const Profile& profile, size_t level, const std::string& file,
                      std::vector<const Profile*>& chain);
    std::optional<size_t> findLevel(const std::string& name, size_t from) const;
    const ConfigFile& fileAt(size_t level) const;

    CommandLineValues command_line_;
    settings::Values environment_;
    std::vector<ConfigFile> files_;      ///< project's file, user's file
    std::string project_folder_;         ///< absolute, with a slash at its end; empty: there is no project
    std::optional<size_t> project_file_; ///< index of files_
    std::string profile_name_;
    std::optional<Profile> profile_file_; ///< chosen profile, if it is a file of its own
    settings::Values profile_values_;
};

} // namespace hearth::profiles
