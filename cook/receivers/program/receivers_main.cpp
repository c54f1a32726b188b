// hearth-receivers: cooks the receivers of one or more sources, baked light whose lamps keep their weights.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/voxels/scene_sky.h"
#include "cook/command_line/command_line.h"
#include "cook/command_line/thread_limit.h"
#include "cook/receivers/program/atlas_part.h"
#include "cook/tools/open_part.h"
#include "formats/base/atomic_file.h"
#include "formats/base/program.h"
#include "formats/pack/pack_check.h"

#include <cstdio>
#include <optional>

namespace
{

using namespace hearth;
using namespace hearth::receivers;

struct Arguments
{
    std::vector<std::string> inputs;
    std::string output;
    std::string probe;  ///< part with the probe of the sky, or empty
    std::string bricks; ///< part with the grid of bricks, or with the reason for none, or empty
    std::string statistics;
    CookSettings settings;
    size_t jobs = 0;
};

/// Print one line for each mesh whose UVs cannot be used.
void warn(const CookedReceivers& cooked, const std::string& output)
{
    for (const UnusableMesh& mesh : cooked.unusable_meshes)
    {
        const Error warning{Issue::receiver_uvs, output, "mesh " + mesh.name + " of " + mesh.source,
                            mesh.reason};
        std::fprintf(stderr, "%s\n", formatMessage(warning).c_str());
    }
}

/// Open the grid of bricks; nullopt if there is none.
Result<std::optional<formats::PackView>> openBricks(const std::string& path)
{
    if (path.empty())
        return std::optional<formats::PackView>();
    HEARTH_ASSIGN_OR_RETURN(formats::PackView part, tools::openPart(path));
    if (part.brickGrid().empty())
        return std::optional<formats::PackView>();
    HEARTH_TRY(formats::checkBricks(part));
    return std::optional<formats::PackView>(std::move(part));
}

Status cook(const Arguments& arguments)
{
    HEARTH_ASSIGN_OR_RETURN(const std::vector<bricks::SourceParts> sources,
                            bricks::openSources(arguments.inputs));
    HEARTH_ASSIGN_OR_RETURN(const bricks::StaticScene scene, bricks::collectStaticScene(sources));
    HEARTH_ASSIGN_OR_RETURN(const bricks::SceneSky sky, bricks::SceneSky::open(scene, arguments.probe));
    HEARTH_ASSIGN_OR_RETURN(const std::optional<formats::PackView> bricks, openBricks(arguments.bricks));
    HEARTH_ASSIGN_OR_RETURN(
        const CookedReceivers cooked,
        cookReceivers(scene, sky.probes(), bricks ? &*bricks : nullptr, arguments.settings));
    HEARTH_TRY(writeReceiversPart(arguments.output, cooked, arguments.settings));
    warn(cooked, arguments.output);
    return arguments.statistics.empty()
               ? success()
               : writeText(arguments.statistics, statisticsJson(cooked, arguments.settings));
}

int run(const Arguments& arguments)
{
    const cli::ThreadLimit limit(arguments.jobs);
    const Status done = cook(arguments);
    return done.ok() ? 0 : reportFailure(done.error());
}

void addOptions(cli::CommandLine& app, Arguments& arguments)
{
    CookSettings& settings = arguments.settings;
    app.addOption("PARTS", arguments.inputs, "import, clusters and textures part of each source").required();
    app.addOption("-o,--output", arguments.output, "receivers part to write").required();
    app.addOption("--texels-per-metre", settings.bake.texels_per_metre, "density of texels")
        .range(kMinTexelsPerMetre, kMaxTexelsPerMetre, "N")
        .showDefault();
    app.addOption("--lights", settings.atlas.select.max_colors,
                  "lamps that a texel keeps at most; with 3 a texel is one record of 16 bytes")
        .range(2u, shared::kMaxReceiverColors, "N")
        .showDefault();
    app.addChoice("--codec", settings.atlas.codec,
                  std::map<std::string, formats::ReceiverCodec>{{"rgb9e5", formats::ReceiverCodec::rgb9e5},
                                                                {"rgbm", formats::ReceiverCodec::rgbm}},
                  "code of colours");
    app.addOption("--bounces", settings.bake.bounces,
                  "bounces of light at most; fewer where they change nothing")
        .range(0u, kMaxBounces, "N")
        .showDefault();
    app.addOption("--probe", arguments.probe,
                  "probe part of the sky that lights the scene; else that of a source, or the default sky");
    app.addOption("--bricks", arguments.bricks,
                  "bricks part of the sources: its faces receive light as well");
    app.addOption("--stats", arguments.statistics, "write statistics as JSON; - is standard output");
    app.addOption("-j,--jobs", arguments.jobs, "threads to use; the result does not depend on it");
    app.setCheck(
        [&arguments]
        {
            return arguments.inputs.size() % 3 == 0
                       ? std::string()
                       : std::string("PARTS: three parts are needed for each source");
        });
    app.setFooter(
        "Example: hearth-receivers room.import.part room.clusters.part room.textures.part "
        "-o room.receivers.part\n"
        "Exit codes: 0 done, 2 usage, 65 malformed input, 66 input missing, 70 internal, 73 cannot write, "
        "74 I/O");
}

int program(int argc, char** argv)
{
    cli::CommandLine app("Bakes the light of each lamp of a scene into texels of its instances.",
                         "hearth-receivers");
    Arguments arguments;
    addOptions(app, arguments);
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    return run(arguments);
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::runProgram("hearth-receivers", [&] { return program(argc, argv); });
}
