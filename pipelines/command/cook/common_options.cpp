// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/cook/common_options.h"

#include "formats/base/regular_file.h"
#include "pipelines/command/cook/setting_options.h"
#include "pipelines/command/shell/messages.h"
#include "pipelines/command/shell/terminal.h"

#include <sstream>
#include <unistd.h>

namespace hearth::command
{

namespace
{

struct CommonOptions
{
    std::string directory;
    std::string config_file;
    SettingOptions settings; ///< --color
    std::string log_format = "text";
};

/// Options of the process, which has one command line.
CommonOptions& common()
{
    static CommonOptions options;
    return options;
}

/// Read the color setting from the command line, the environment or a configuration file. Errors of a file
/// are ignored here: the verbs that need the file report them.
ColorChoice readColorChoice()
{
    const Result<profiles::CommandLineValues> overrides = common().settings.overrides();
    const Result<profiles::Configuration> configuration = loadConfiguration({});
    const settings::Value* color = nullptr;
    if (overrides.ok() && overrides->command.contains("color"))
        color = &overrides->command.find("color")->second;
    else if (configuration.ok())
        color = configuration->command("color");
    const std::string word = color == nullptr ? "auto" : settings::valueTexts(*color).front();
    return word == "always"  ? ColorChoice::always
           : word == "never" ? ColorChoice::never
                             : ColorChoice::automatic;
}

} // namespace

void addCommonOptions(cli::CommandLine& app)
{
    app.addOption("-C,--directory", common().directory, "work as if started in this folder").typeName("DIR");
    app.addOption("--config", common().config_file,
                  "file of settings, instead of hearth.toml here or above; off: none")
        .typeName("FILE");
    common().settings.addCommandSettings(app, {"color"});
    app.addOption("--log-format", common().log_format, "of messages; json: an object a line")
        .choices({"text", "json"}, "text|json");
}

Status applyCommonOptions()
{
    if (common().log_format == "json")
        setMessageFormat(MessageFormat::json);
    const std::string& directory = common().directory;
    if (!directory.empty() && ::chdir(directory.c_str()) != 0)
        return Error{Issue::input_missing, directory, "", "is no folder that can be entered"};
    // after chdir: hearth.toml is searched from the working folder
    setColorChoice(readColorChoice());
    return success();
}

Result<profiles::Configuration> loadConfiguration(profiles::CommandLineValues overrides)
{
    overrides.config_file = common().config_file;
    HEARTH_ASSIGN_OR_RETURN(profiles::CommandLineValues common_overrides, common().settings.overrides());
    overrides.command.merge(common_overrides.command);
    return profiles::Configuration::load(std::move(overrides));
}

std::vector<std::string> cacheSettings(const profiles::Configuration& configuration)
{
    const settings::Value* caches = configuration.command("cache");
    // HEARTH_CACHE is read where caches are opened: it may be "off"
    return caches == nullptr || caches->origin == "HEARTH_CACHE" ? std::vector<std::string>()
                                                                 : settings::valueTexts(*caches);
}

Result<std::vector<cache::CacheSpec>> readCacheSpecs(const profiles::Configuration& configuration)
{
    return cache::resolveCacheSpecs(cacheSettings(configuration));
}

Result<std::vector<std::string>> expandArgumentFiles(const std::vector<std::string>& words)
{
    std::vector<std::string> all;
    for (const std::string& word : words)
    {
        if (word.size() < 2 || word.front() != '@')
        {
            all.push_back(word);
            continue;
        }
        HEARTH_ASSIGN_OR_RETURN(const std::string text, readFile(word.substr(1)));
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);)
            if (!line.empty() && line.front() != '#')
                all.push_back(line);
    }
    return all;
}

} // namespace hearth::command
