// hearth-link: merges import, clusters, textures and skinning parts into a pack, with a table of specular occlusion and a grid of bricks.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/program.h"
#include "pipelines/link/link.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <vector>

namespace
{

int program(int argc, char** argv)
{
    CLI::App app("Merge the parts of one or more sources into a pack.", "hearth-link");
    std::vector<std::string> parts;
    std::string output;
    std::vector<std::string> specular_parts;
    std::string bricks_part;
    app.add_option("PARTS", parts, "import, clusters, textures and skinning part of each source")->required();
    app.add_option("-o,--output", output, "pack to write")->required();
    app.add_option("--specular", specular_parts, "specular part, whose table the pack gets; once each")
        ->allow_extra_args(false);
    app.add_option("--bricks", bricks_part, "bricks part, whose grid the pack gets");
    try
    {
        app.parse(argc, argv);
        if (parts.size() % 4 != 0)
            throw CLI::ValidationError("PARTS", "four parts are needed for each source");
    }
    catch (const CLI::CallForHelp&)
    {
        std::printf("%s", app.help().c_str());
        return 0;
    }
    catch (const CLI::ParseError& error)
    {
        std::fprintf(stderr, "%s\n",
                     hearth::formatMessage({hearth::Issue::usage, "hearth-link", "", error.what()}).c_str());
        return 2;
    }

    std::vector<hearth::link::SourceParts> sources;
    for (size_t i = 0; i < parts.size(); i += 4)
        sources.push_back({parts[i], parts[i + 1], parts[i + 2], parts[i + 3]});
    const hearth::Status status = hearth::link::linkPack(sources, output, specular_parts, bricks_part);
    if (status.ok())
        return 0;
    std::fprintf(stderr, "%s\n", formatMessage(status.error()).c_str());
    return exitCode(status.error());
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::runProgram("hearth-link", [&] { return program(argc, argv); });
}
