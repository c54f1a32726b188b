// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/shell/config_schema.h"
#include "pipelines/command/shell/verb_tools.h"
#include "pipelines/command/shell/verbs.h"
#include "pipelines/schemas/schemas.h"

namespace hearth::command
{

namespace
{

constexpr const char* kConfig = "config"; // generated from the table of settings

std::vector<std::string> names()
{
    std::vector<std::string> names{kConfig};
    for (const schemas::Schema& schema : schemas::all())
        names.emplace_back(schema.name);
    return names;
}

int printSchema(const std::string& name)
{
    for (const schemas::Schema& schema : schemas::all())
        if (schema.name == name)
            return printResult(std::string(schema.text));
    return printResult(configSchema());
}

} // namespace

void addSchema(cli::CommandLine& app, VerbAction& run)
{
    cli::CommandLine& verb =
        app.addSubcommand("schema", "Print the JSON Schema of something that Hearth writes or reads");
    auto name = std::make_shared<std::string>();
    verb.addOption("NAME", *name,
                   "what it is of; config: hearth.toml, the others: --format json and the like")
        .required()
        .choices(names());
    verb.setFooter("Example: hearth schema config > hearth.schema.json");
    verb.setAction([name, &run] { run = [name] { return printSchema(*name); }; });
}

} // namespace hearth::command
