// The options that set what files and the environment can set as well: of the command, and of how sources are cooked down.
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

class SettingOptions
{
public:
    // It lives as long as the verb.

    /// Add those of the command's settings with these keys.
    void addOfCommand(cli::CommandLine& verb, const std::vector<std::string>& keys);
    /// Add -q, and -v where `all` says what that prints: the command's setting "log".
    void addLog(cli::CommandLine& verb, const std::string& all);
    /// Add those of the settings of profiles, and --set.
    void addOfProfiles(cli::CommandLine& verb);

    /// What the command line says. errors: usage.
    Result<profiles::Given> given() const;
    /// With that over all else. errors: usage, and those of Configuration::load
    Result<profiles::Configuration> configuration() const;

private:
    struct Entry
    {
        const profiles::Setting* setting = nullptr;
        std::optional<cli::Option> option;
        bool flag = false;
        std::string word;
        std::vector<std::string> words;
    };
    void add(cli::CommandLine& verb, const profiles::Setting& setting);
    static Result<profiles::Value> valueOf(const Entry& entry);

    // not moved while the command line refers to them
    std::map<std::string, Entry> entries_;
    std::vector<std::string> assignments_;
    bool is_quiet_ = false;
    bool is_verbose_ = false;
};

/// The work of a verb that is told what holds, once the command line is read; the settings live as long as the work.
Work withConfiguration(const SettingOptions& settings,
                       const std::function<int(const profiles::Configuration&)>& work);

Effort effortOf(const profiles::Configuration& configuration);

/// Have the sources cooked as the configuration says: what folders and patterns stand for, which files are levels of detail of
/// others, settings of each source and of the pack, and the options of the command that the command line leaves open.
/// errors: no_source, usage, profile_value
Status configure(const profiles::Configuration& configuration, CookOptions& options);

/// The same as data that a plan can hold: what each source is cooked by, wherever it was written.
/// options  with what the user typed; they are configured as for hearth cook
/// errors   those of configure
Result<farm::Request> requestOf(const profiles::Configuration& configuration, CookOptions& options);

} // namespace hearth::command
