// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/cache/open_cache.h"
#include "pipelines/command/cook.h"
#include "pipelines/command/verb_tools.h"
#include "pipelines/command/verbs.h"
#include "pipelines/command/watch.h"

#include <CLI/CLI.hpp>
#include <cmath>

namespace hearth::command
{

void addCook(CLI::App& app, Work& run)
{
    CLI::App* verb = app.add_subcommand("cook", "Turn sources into a pack");
    struct Options : CookOptions
    {
        bool bakes_visibility = false;
        VisibilityOptions baked;
        bool makes_bricks = false;
        BrickOptions bricked;
        std::string memory;
        bool watches = false;
        bool quiet = false;
        bool verbose = false;
    };
    auto options = std::make_shared<Options>();
    verb->add_option("SOURCE", options->sources, "glTF, GLB, OBJ, PLY, STL, OFF, Draco or image files")
        ->required();
    verb->add_option("-o,--output", options->output, "pack to write")->required();
    verb->add_option("-j,--jobs", options->jobs,
                     "cookers that run at once; two by default, and of small sources one a core")
        ->check(CLI::Range(1, 1024));
    verb->add_option("--memory", options->memory,
                     "what the cookers may take together, as 12G; three quarters of the machine's by default")
        ->check(CLI::Validator(sizeFault, ""));
    verb->add_option("--lod", options->lods,
                     "N=FILE: level of detail N of the source's only mesh, made by hand")
        ->allow_extra_args(false);
    verb->add_option("--profile", options->profile,
                     "TOML file that says how far each level of detail is simplified");
    auto* visibility =
        verb->add_flag("--visibility", options->bakes_visibility,
                       "bake what each vertex sees of its surroundings: ambient and specular occlusion");
    verb->add_option("--visibility-quality", options->baked.quality, "rays that it takes")
        ->check(CLI::IsMember({"draft", "default", "high"}))
        ->needs(visibility);
    verb->add_option("--visibility-occluders", options->baked.occluders,
                     "what is in the way: all of the source's scene, or each asset alone")
        ->check(CLI::IsMember({"scene", "asset"}))
        ->needs(visibility);
    auto* distance = verb->add_option("--visibility-distance", options->baked.distance,
                                      "metres: what is farther away hides nothing; no limit by default")
                         ->check(CLI::PositiveNumber)
                         ->needs(visibility);
    verb->add_option("--visibility-power", options->baked.power,
                     "visibility of what is t metres away is (t / distance)^power; nothing by default")
        ->check(CLI::Range(0.0, 16.0))
        ->needs(distance);
    verb->add_option("--visibility-poses", options->baked.poses,
                     "CLIP[@SECONDS,...]: bake deformed meshes in these poses, not in the bind pose; once "
                     "for each clip")
        ->allow_extra_args(false)
        ->needs(visibility);
    verb->add_flag("--visibility-refine", options->baked.refine,
                   "cones by nine harmonics instead of four moments; the report says what that gained")
        ->needs(visibility);
    auto* bricks = verb->add_flag("--bricks", options->makes_bricks,
                                  "make the grid of bricks that global illumination is marched through");
    verb->add_option("--voxel-size", options->bricked.voxel_size,
                     "metres, of the bricks' voxels; by default as their memory allows")
        ->check(
            [](const std::string& text)
            {
                const double value = std::strtod(text.c_str(), nullptr);
                return std::isfinite(value) && value > 0 ? std::string() : text + " is not a size in metres";
            })
        ->needs(bricks);
    verb->add_option("--brick-memory", options->bricked.memory_bytes,
                     "bytes that the bricks may take on the GPU; 20 MiB by default")
        ->check(CLI::Range(uint64_t{1}, uint64_t{1} << 40).description(""))
        ->needs(bricks);
    verb->add_option("--brick-bake", options->bricked.bounces,
                     "bake the light that bricks start with, of so many bounces")
        ->check(CLI::Range(0u, 64u).description(""))
        ->needs(bricks);
    verb->add_option("--report", options->report_file, "write a report as JSON");
    verb->add_option("--events", options->events_file,
                     "write what happens while it happens, a JSON object a line");
    verb->add_flag("--fail-fast", options->fail_fast, "end at the first failure, not after all sources");
    addCaches(*verb, options->caches);
    auto* no_cache = verb->add_flag("--no-cache", options->no_cache, "run every cooker and keep nothing");
    verb->add_flag("-f,--force", options->force, "run every cooker, whatever the cache has")
        ->excludes(no_cache);
    auto* depfile = verb->add_option("--depfile", options->depfile,
                                     "write what was read, textures that were found too, for make or ninja");
    auto* dry_run = verb->add_flag("-n,--dry-run", options->dry_run, "only say what would run, and why")
                        ->excludes(depfile);
    verb->add_option("--format", options->dry_run_format, "of --dry-run; json: the whole plan")
        ->check(CLI::IsMember({"text", "json"}))
        ->needs(dry_run);
    verb->add_flag("--watch", options->watches,
                   "cook, and again whenever a file changes that it reads or looks for; Ctrl-C ends it")
        ->excludes(dry_run);
    verb->add_flag("--explain", options->explain, "say why each cooker runs");
    auto* quiet = verb->add_flag("-q,--quiet", options->quiet, "print errors only");
    verb->add_flag("-v,--verbose", options->verbose, "print the command line of every stage")
        ->excludes(quiet);
    verb->footer("Example: hearth cook house.glb tree.glb -o village.hearth\n"
                 "Several sources become one pack, their scenes side by side.\n"
                 "A second cook runs only the cookers whose input has changed.");
    verb->callback(
        [options, &run]
        {
            options->verbosity = options->quiet     ? Verbosity::quiet
                                 : options->verbose ? Verbosity::all
                                                    : Verbosity::normal;
            if (options->bakes_visibility)
                options->visibility = options->baked;
            if (options->makes_bricks)
                options->bricks = options->bricked;
            if (!options->memory.empty())
                options->memory_bytes = cache::parseSize(options->memory, "").value();
            run = [options] { return options->watches ? watch(*options) : cook(*options); };
        });
}

} // namespace hearth::command
