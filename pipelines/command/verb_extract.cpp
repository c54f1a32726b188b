// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/extract.h"
#include "pipelines/command/extract_bricks.h"
#include "pipelines/command/extract_specular.h"
#include "pipelines/command/verb_tools.h"
#include "pipelines/command/verbs.h"

#include <CLI/CLI.hpp>
#include <cmath>

namespace hearth::command
{

void addExtract(CLI::App& app, Work& run)
{
    CLI::App* verb =
        app.add_subcommand("extract", "Write a level of detail of a mesh as PLY, or a table as CSV");
    struct Options
    {
        std::string file;
        uint32_t mesh = 0;
        float error = 0;
        std::string part;
        std::string animation;
        double time = 0;
        std::string output;
    };
    auto options = std::make_shared<Options>();
    verb->add_option("FILE", options->file, "pack")->required();
    CLI::Option* mesh = verb->add_option("--mesh", options->mesh, "index of the mesh");
    CLI::Option* error = verb->add_option("--error", options->error,
                                          "largest error in the mesh's own units; 0: the source's triangles");
    mesh->needs(error);
    error->needs(mesh);
    const CLI::Option* part =
        verb->add_option("--part", options->part,
                         "instead of a mesh; specular: its table, bricks: the faces of all solid voxels")
            ->check(CLI::IsMember({"specular", "bricks"}))
            ->excludes(mesh);
    CLI::Option* animation = verb->add_option(
        "--animation", options->animation, "clip that poses the mesh: its name, or its index if it has none");
    animation->needs(mesh);
    verb->add_option("--time", options->time, "seconds from the start of the clip")->needs("--animation");
    verb->add_option("-o,--output", options->output, "PLY or CSV file to write")->required();
    verb->footer("Example: hearth extract village.hearth --mesh 0 --error 0.01 -o cut.ply");
    verb->callback(
        [options, mesh, part, animation, &run]
        {
            if (mesh->count() + part->count() == 0)
                throw CLI::RequiredError("--mesh");
            run = [options, part, animation]
            {
                if (part->count() > 0)
                {
                    const Status status = options->part == "bricks"
                                              ? extractBricks(options->file, options->output)
                                              : extractSpecular(options->file, options->output);
                    return status.ok() ? 0 : fail(status.error());
                }
                if (!(options->error >= 0) || !std::isfinite(options->error))
                    return usageError("--error must be a number from 0 on");
                if (!std::isfinite(options->time))
                    return usageError("--time must be a number");
                std::optional<ClipTime> clip;
                if (animation->count() > 0)
                    clip = ClipTime{options->animation, options->time};
                const Status status =
                    extractCut(options->file, options->mesh, options->error, clip, options->output);
                return status.ok() ? 0 : fail(status.error());
            };
        });
}

} // namespace hearth::command
