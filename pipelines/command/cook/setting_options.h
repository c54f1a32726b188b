// Command-line options of settings that files and the environment can set as well: settings of the command,
// and of cooking.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/command_line/command_line.h"
#include "pipelines/command/cook/cook.h"
#include "pipelines/command/shell/verbs.h"
#include "pipelines/farm/request.h"
#include "pipelines/profiles/configuration.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace hearth::command
{

/// Options of one verb for settings, and the values that they got.
class SettingOptions
{
public:
    // Must live as long as the verb's command line.

    /// Add options for the settings of the command with these keys.
    void addCommandSettings(cli::CommandLine& verb, const std::vector<std::string>& keys);
    /// Add -q, and -v if its help text `all` is not empty: the command's setting "log".
    void addVerbosityOptions(cli::CommandLine& verb, const std::string& all);
    /// Add options for the settings of profiles, and --set.
    void addProfileSettings(cli::CommandLine& verb);

    /// Return the settings on the command line. errors: usage.
    Result<profiles::CommandLineValues> overrides() const;
    /// Load the configuration, which these settings override. errors: usage, and those of Configuration::load
    Result<profiles::Configuration> configuration() const;

private:
    struct Entry
    {
        const settings::Setting* setting = nullptr;
        std::optional<cli::Option> option;
        bool flag = false;
        std::string word;
        std::vector<std::string> words;
    };
    void add(cli::CommandLine& verb, const settings::Setting& setting);
    static Result<settings::Value> getValue(const Entry& entry);

    // entries must not move while the command line refers to them
    std::map<std::string, Entry> entries_;
    std::vector<std::string> assignments_;
    bool is_quiet_ = false;
    bool is_verbose_ = false;
};

/// Return the work of a verb that needs the configuration, which is loaded when the work runs. `settings`
/// must outlive the work.
VerbAction withConfiguration(const SettingOptions& settings,
                             const std::function<int(const profiles::Configuration&)>& work);

RunLimits readRunLimits(const profiles::Configuration& configuration);

/// Apply the configuration to `options`: expand folders and patterns, find which files are LODs of others,
/// set the settings of each source and of the pack, and the options of the command that the command line
/// leaves open.
/// errors: no_source, usage, profile_value
Status applyConfiguration(const profiles::Configuration& configuration, CookOptions& options);

/// Same, as data for a plan: the settings of each source, wherever they were written.
/// options  as the user typed them; they are configured as for hearth cook
/// errors: those of applyConfiguration
Result<farm::Request> makeRequest(const profiles::Configuration& configuration, CookOptions& options);

} // namespace hearth::command
