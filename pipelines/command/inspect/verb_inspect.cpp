// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/extract/open_pack.h"
#include "pipelines/command/inspect/inspect.h"
#include "pipelines/command/inspect/inspect_bounds.h"
#include "pipelines/command/shell/verb_tools.h"
#include "pipelines/command/shell/verbs.h"
#include "pipelines/command/topology/inspect_topology.h"

#include <cmath>

namespace hearth::command
{

namespace
{

int inspect(const std::string& file, const std::string& format)
{
    const auto pack = openContainer(file);
    if (!pack.ok())
        return printError(pack.error());
    const PackSummary summary = summarize(*pack);
    return printResult(format == "json" ? inspectJson(*pack, summary) : inspectText(*pack, summary));
}

} // namespace

void addInspect(cli::CommandLine& app, VerbAction& run)
{
    cli::CommandLine& verb =
        app.addSubcommand("inspect", "Say what is in a pack, or what is wrong with the meshes of a source");
    struct Options
    {
        std::string file;
        std::string format = "text";
        bool bounds = false;
        std::string animation;
        double time = 0;
        bool topology = false;
        std::string ply;
    };
    auto options = std::make_shared<Options>();
    verb.addOption("FILE", options->file, "pack or part; with --topology a source or its import part")
        .required();
    addFormat(verb, options->format);
    const cli::Option bounds = verb.addFlag(
        "--bounds", options->bounds, "the boxes of all clusters of a pack in a pose, with --format json");
    const cli::Option animation = verb.addOption("--animation", options->animation,
                                                 "clip of the pose: its name, or its index if it has none")
                                      .needs(bounds);
    verb.addOption("--time", options->time, "seconds from the start of the clip").needs(animation);
    const cli::Option topology =
        verb.addFlag("--topology", options->topology,
                     "of each mesh of a source: pieces, boundary loops, non-manifold edges and vertices, "
                     "flipped and doubled shells, genus, T-junctions, self-intersections")
            .excludes(bounds);
    verb.addOption(
            "--ply", options->ply,
            "PLY file to write: these findings as coloured points, edges and faces, for Blender or MeshLab; "
            "a folder gets a file for each kind")
        .needs(topology);
    verb.setFooter("Examples:\n"
                   "  hearth inspect village.hearth --format json\n"
                   "  hearth inspect fox.hearth --bounds --animation Run --time 0.5 --format json\n"
                   "  hearth inspect rock.glb --topology --ply findings.ply");
    verb.setAction(
        [options, animation, &run]
        {
            run = [options, animation]
            {
                if (options->ply == "-")
                    return printUsageError("--ply needs a file: the report is printed");
                if (options->topology)
                    return inspectTopology({options->file, options->format == "json", options->ply});
                if (!options->bounds)
                    return inspect(options->file, options->format);
                if (options->format != "json")
                    return printUsageError("--bounds needs --format json");
                if (!std::isfinite(options->time))
                    return printUsageError("--time must be a number");
                std::optional<ClipTime> clip;
                if (animation.count() > 0)
                    clip = ClipTime{options->animation, options->time};
                return printResult(boundsJson(options->file, clip));
            };
        });
}

} // namespace hearth::command
