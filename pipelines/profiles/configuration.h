// The settings that hold here: of the command line, the environment, the project, the user, and those built in.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/profiles/config_file.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace hearth::profiles
{

/// Reads a variable of the environment; nullopt where it is not set, or empty.
using Environment = std::function<std::optional<std::string>(const char* name)>;
std::optional<std::string> processEnvironment(const char* name);

/// The first of a setting's switches that is set; nullptr where none is.
const Switch* switchSet(const Setting& setting, const Environment& environment = processEnvironment);

/// What the command line says.
struct Given
{
    std::string
        config_file; ///< --config: a project's file, or "off" for no file at all; empty: see Configuration::load
    Values command;  ///< of commandSettings()
    Values settings; ///< of profileSettings(), for all sources
};

class Configuration
{
public:
    /// Read what there is. The project's file is --config, else HEARTH_CONFIG, else hearth.toml in the working folder or the
    /// nearest one above; the user's is hearth/config.toml in XDG_CONFIG_HOME or ~/.config. "off" for the first two: neither
    /// is read. Then choose the profile: that of the command line, of HEARTH_PROFILE, of [defaults] of the project, of the
    /// user's, or none.
    ///
    /// errors  input_missing, profile_syntax, profile_key, profile_value, profile_unknown, profile_circle
    static Result<Configuration> load(Given given, const Environment& environment = processEnvironment);

    /// Of commandSettings(); nullptr where nobody has set it.
    const Value* command(std::string_view key) const;

    /// All that somebody has set for a source: its profile with what that inherits, the rules that match it, later ones over
    /// earlier ones, and the command line over all. Of settings of the pack: the same without rules.
    ///
    /// source  as the user typed it; rules match its path from the folder of the project's file
    Values ofSource(const std::string& source) const;
    Values ofPack() const;

    /// The name of the chosen profile; empty: none.
    const std::string& profileName() const { return profile_name_; }
    /// The files that were read, nearest first.
    const std::vector<ConfigFile>& files() const { return files_; }
    /// The one that may have rules; nullptr where there is none.
    const ConfigFile* projectFile() const;
    /// The folder of the project's file, absolute, with a slash at its end; empty where there is none.
    const std::string& projectFolder() const { return project_folder_; }
    /// The path of a source from that folder, by which rules match it; empty where it lies elsewhere.
    std::string pathInProject(const std::string& source) const;

private:
    Status readFiles(const Environment& environment);
    Status readEnvironment(const Environment& environment);
    Status chooseProfile();
    Status addProfile(const Profile& profile, size_t level, const std::string& file,
                      std::vector<const Profile*>& chain);
    std::optional<size_t> levelOf(const std::string& name, size_t from) const;
    const ConfigFile& fileAt(size_t level) const;

    Given given_;
    Values environment_;
    std::vector<ConfigFile> files_;      ///< the project's, the user's
    std::string project_folder_;         ///< absolute, with its slash; empty: there is no project
    std::optional<size_t> project_file_; ///< index of files_
    std::string profile_name_;
    std::optional<Profile> own_file_; ///< of a profile that is a file of its own
    Values of_profile_;
};

} // namespace hearth::profiles
