// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/verb_cook.h"
#include "pipelines/cache/open_cache.h"
#include "pipelines/command/verb_tools.h"
#include "pipelines/command/verbs.h"

#include <CLI/CLI.hpp>
#include <cmath>

namespace hearth::command
{

void addSettings(CLI::App* verb, const std::shared_ptr<SettingsOptions>& options)
{
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
}

void takeSettings(SettingsOptions& options)
{
    if (options.bakes_visibility)
        options.visibility = options.baked;
    if (options.makes_bricks)
        options.bricks = options.bricked;
}

std::vector<std::string> chosenSettings(const CLI::App& verb)
{
    CLI::App settings;
    addSettings(&settings, std::make_shared<SettingsOptions>());
    std::vector<std::string> words;
    for (const CLI::Option* setting : settings.get_options())
    {
        const CLI::Option* option = verb.get_option_no_throw(setting->get_name());
        if (option == nullptr || option->count() == 0)
            continue;
        const bool is_flag = option->get_items_expected_max() == 0;
        for (const std::string& result : option->results())
        {
            words.push_back(option->get_name());
            if (!is_flag)
                words.push_back(result);
        }
    }
    return words;
}

Result<graph::CookSettings> readRequest(const farm::Request& request)
{
    CLI::App settings;
    const auto options = std::make_shared<SettingsOptions>();
    addSettings(&settings, options);
    // the last word is taken first
    std::vector<std::string> words(request.options.rbegin(), request.options.rend());
    try
    {
        settings.parse(std::move(words));
    }
    catch (const CLI::ParseError& error)
    {
        return Error{Issue::usage, "hearth", "", error.what()};
    }
    takeSettings(*options);
    if (request.sources.empty())
        return Error{Issue::usage, "hearth", "", "there are no sources"};
    options->sources = request.sources;
    options->output = farm::kPackName;
    options->statistics = request.statistics;
    return graph::CookSettings(*options);
}

void addCook(CLI::App& app, Work& run)
{
    CLI::App* verb = app.add_subcommand("cook", "Turn sources into a pack");
    struct Options : SettingsOptions
    {
        std::string memory;
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
    addSettings(verb, options);
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
            options->verbosity = verbosityOf(options->quiet, options->verbose);
            takeSettings(*options);
            if (!options->memory.empty())
                options->memory_bytes = cache::parseSize(options->memory, "").value();
            run = [options] { return cook(*options); };
        });
}

} // namespace hearth::command
