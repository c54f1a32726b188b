// The options that say how sources are cooked down: --profile, --set, and one for each setting that has one.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/command/cook.h"
#include "pipelines/farm/request.h"
#include "pipelines/profiles/configuration.h"

#include <map>
#include <string>
#include <vector>

namespace CLI
{
class App;
class Option;
} // namespace CLI

namespace hearth::command
{

class SettingOptions
{
public:
    /// Add those of the settings of profiles, and of the command's those with these keys. Lives as long as the verb.
    void addTo(CLI::App& verb, const std::vector<std::string>& command_keys);

    /// What the command line says. errors: usage.
    Result<profiles::Given> given() const;

private:
    struct Entry
    {
        const profiles::Setting* setting = nullptr;
        const CLI::Option* option = nullptr;
        bool flag = false;
        std::string word;
        std::vector<std::string> words;
    };
    Entry& add(CLI::App& verb, const profiles::Setting& setting);
    static Result<profiles::Value> valueOf(const Entry& entry);

    // not moved while the command line refers to them
    std::map<std::string, Entry> entries_;
    std::vector<std::string> assignments_;
};

/// Have the sources cooked as the configuration says: what folders and patterns stand for, settings of each source and of the
/// pack, and the options of the command that the command line leaves open.
/// errors: no_source, usage, profile_value
Status configure(const profiles::Configuration& configuration, CookOptions& options);

/// The same as data that a plan can hold: what each source is cooked by, wherever it was written.
/// sources  as the user typed them
/// errors   those of configure
Result<farm::Request> requestOf(const profiles::Configuration& configuration,
                                const std::vector<std::string>& sources);

} // namespace hearth::command
