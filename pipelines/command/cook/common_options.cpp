// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/cook/common_options.h"

#include "pipelines/cache/directory_store.h"
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
ColorWish colorWish()
{
    const Result<profiles::Given> given = common().settings.given();
    const Result<profiles::Configuration> configuration = loadConfiguration({});
    const profiles::Value* color = nullptr;
    if (given.ok() && given->command.contains("color"))
        color = &given->command.find("color")->second;
    else if (configuration.ok())
        color = configuration->command("color");
    const std::string word = color == nullptr ? "auto" : profiles::textsOf(*color).front();
    return word == "always" ? ColorWish::always : word == "never" ? ColorWish::never : ColorWish::automatic;
}

} // namespace

void addCommonOptions(cli::CommandLine& app)
{
    app.addOption("-C,--directory", common().directory, "work as if started in this folder").typeName("DIR");
    app.addOption("--config", common().config_file,
                  "file of settings, instead of hearth.toml here or above; off: none")
        .typeName("FILE");
    common().settings.addOfCommand(app, {"color"});
    app.addOption("--log-format", common().log_format, "of messages; json: an object a line")
        .choices({"text", "json"}, "text|json");
}

Status applyCommonOptions()
{
    if (common().log_format == "json")
        setMessageForm(MessageForm::json);
    const std::string& directory = common().directory;
    if (!directory.empty() && ::chdir(directory.c_str()) != 0)
        return Error{Issue::input_missing, directory, "", "is no folder that can be entered"};
    // after chdir: hearth.toml is searched from the working folder
    setColor(colorWish());
    return success();
}

Result<profiles::Configuration> loadConfiguration(profiles::Given given)
{
    given.config_file = common().config_file;
    HEARTH_ASSIGN_OR_RETURN(profiles::Given of_all_verbs, common().settings.given());
    given.command.merge(of_all_verbs.command);
    return profiles::Configuration::load(std::move(given));
}

std::vector<std::string> cachesOf(const profiles::Configuration& configuration)
{
    const profiles::Value* caches = configuration.command("cache");
    // HEARTH_CACHE is read where caches are opened: it may be "off"
    return caches == nullptr || caches->origin == "HEARTH_CACHE" ? std::vector<std::string>()
                                                                 : profiles::textsOf(*caches);
}

Result<std::vector<cache::LevelSpec>> levelsOf(const profiles::Configuration& configuration)
{
    return cache::cacheSpecs(cachesOf(configuration));
}

Result<std::vector<std::string>> withArgumentFiles(const std::vector<std::string>& words)
{
    std::vector<std::string> all;
    for (const std::string& word : words)
    {
        if (word.size() < 2 || word.front() != '@')
        {
            all.push_back(word);
            continue;
        }
        const std::optional<std::string> text = cache::readText(word.substr(1));
        if (!text)
            return Error{Issue::input_missing, word.substr(1), "", "the list of arguments cannot be read"};
        std::istringstream lines(*text);
        for (std::string line; std::getline(lines, line);)
            if (!line.empty() && line.front() != '#')
                all.push_back(line);
    }
    return all;
}

} // namespace hearth::command
