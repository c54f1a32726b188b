// hearth-link: merges import, clusters, textures and skinning parts into a pack, with proxies, a table of
// specular occlusion, light probes, a grid of bricks and receivers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "cook/tools/part_of_source.h"
#include "formats/base/program.h"
#include "pipelines/link/link.h"

#include <cstdio>
#include <string>
#include <vector>

namespace
{

int program(int argc, char** argv)
{
    hearth::cli::CommandLine app("Merge the parts of one or more sources into a pack.", "hearth-link");
    std::vector<std::string> parts;
    std::string output;
    hearth::link::PackParts pack_parts;
    std::vector<std::string> skipped;
    uint64_t texture_budget = 0;
    app.addOption("PARTS", parts, "import, clusters, textures and skinning part of each source").required();
    app.addOption("-o,--output", output, "pack to write").required();
    std::vector<std::string> proxies;
    app.addOption("--proxies", proxies,
                  "N=PART: proxy part of source N, counted from 0; once for each source that has one")
        .oneValueEach();
    app.addOption("--specular", pack_parts.specular, "specular part, whose table the pack gets; once each")
        .oneValueEach();
    app.addOption("--bricks", pack_parts.bricks, "bricks part, whose grid the pack gets");
    app.addOption("--probe", pack_parts.probes, "probe part, whose light probes the pack gets; once each")
        .oneValueEach();
    app.addOption("--receivers", pack_parts.receivers, "receivers part, whose atlas the pack gets");
    app.addOption("--skipped", skipped,
                  "JSON with source, code, pointer and text: an error of a source that the pack lacks, which "
                  "hearth inspect shows; once for each")
        .oneValueEach();
    app.addOption(
           "--texture-budget", texture_budget,
           "bytes that the textures may take on the GPU, as hearth-budget has shared them, which hearth "
           "inspect shows")
        .range(uint64_t{1}, uint64_t{1} << 60, "BYTES");
    app.setCheck(
        [&parts]
        { return parts.size() % 4 == 0 ? std::string() : "PARTS: four parts are needed for each source"; });
    const hearth::cli::ParseResult parsed = app.parseWords({argv + 1, argv + argc});
    if (parsed.wants_help)
    {
        std::printf("%s", app.help().c_str());
        return 0;
    }
    if (!parsed.fault.empty())
        return hearth::reportFailure({hearth::Issue::usage, "hearth-link", "", parsed.fault});

    std::vector<hearth::link::SourceParts> sources;
    for (size_t i = 0; i < parts.size(); i += 4)
        sources.push_back({parts[i], parts[i + 1], parts[i + 2], parts[i + 3]});
    for (const std::string& text : proxies)
    {
        const hearth::Result<hearth::tools::PartOfSource> proxy =
            hearth::tools::parsePartOfSource(text, sources.size(), "hearth-link", "--proxies");
        if (!proxy.ok())
            return hearth::reportFailure(proxy.error());
        sources[proxy->source].proxy_part = proxy->path;
    }
    const hearth::Status status =
        hearth::link::linkPack(sources, output, pack_parts, skipped, texture_budget);
    return status.ok() ? 0 : reportFailure(status.error());
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::runProgram("hearth-link", [&] { return program(argc, argv); });
}
