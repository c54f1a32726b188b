// hearth: the command that users type. Reads the command line; each verb's work is in its own file.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/tools/suggest.h"
#include "formats/program.h"
#include "pipelines/cache/open_cache.h"
#include "pipelines/command/cache_verbs.h"
#include "pipelines/command/cook.h"
#include "pipelines/command/explain.h"
#include "pipelines/command/extract.h"
#include "pipelines/command/extract_bricks.h"
#include "pipelines/command/extract_specular.h"
#include "pipelines/command/inspect.h"
#include "pipelines/command/inspect_bounds.h"
#include "pipelines/command/open_pack.h"
#include "pipelines/command/verify.h"
#include "pipelines/command/why.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>

namespace
{

using namespace hearth;

// Every verb fills its options while the command line is read; `run` then holds its work.
using Work = std::function<int()>;

int fail(const Error& error)
{
    std::fprintf(stderr, "%s\n", formatMessage(error).c_str());
    return exitCode(error);
}

int usageError(const std::string& what)
{
    return fail({Issue::usage, "hearth", "", what});
}

/// Results go to stdout; a pipe that does not take them is an error like any other.
int printResult(const std::string& text)
{
    if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0)
        return 0;
    return fail({Issue::read_failed, "stdout", "", "cannot be written"});
}

int printResult(const Result<std::string>& result)
{
    return result.ok() ? printResult(*result) : fail(result.error());
}

void addFormat(CLI::App& verb, std::string& format)
{
    verb.add_option("--format", format, "how the result is written")
        ->check(CLI::IsMember({"text", "json"}))
        ->capture_default_str();
}

void addCaches(CLI::App& verb, std::vector<std::string>& caches)
{
    verb.add_option(
            "--cache", caches,
            "dir:FOLDER[,ro][,size=20G]; may be repeated, nearest first; HEARTH_CACHE or the user's own "
            "by default")
        ->allow_extra_args(false);
}

/// For sizes such as 512M.
std::string sizeFault(const std::string& text)
{
    const Result<uint64_t> size = cache::parseSize(text, "");
    return size.ok() ? "" : size.error().detail;
}

// ---- verbs

void addCook(CLI::App& app, Work& run)
{
    CLI::App* verb = app.add_subcommand("cook", "Turn sources into a pack");
    struct Options : command::CookOptions
    {
        bool bakes_visibility = false;
        command::VisibilityOptions baked;
        bool makes_bricks = false;
        command::BrickOptions bricked;
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
    auto* dry_run = verb->add_flag("-n,--dry-run", options->dry_run, "only say what would run, and why");
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
            options->verbosity = options->quiet     ? command::Verbosity::quiet
                                 : options->verbose ? command::Verbosity::all
                                                    : command::Verbosity::normal;
            if (options->bakes_visibility)
                options->visibility = options->baked;
            if (options->makes_bricks)
                options->bricks = options->bricked;
            if (!options->memory.empty())
                options->memory_bytes = cache::parseSize(options->memory, "").value();
            run = [options] { return command::cook(*options); };
        });
}

int inspect(const std::string& file, const std::string& format)
{
    const auto pack = command::openContainer(file);
    if (!pack.ok())
        return fail(pack.error());
    const command::PackSummary summary = command::summarize(*pack);
    return printResult(format == "json" ? command::inspectJson(*pack, summary)
                                        : command::inspectText(*pack, summary));
}

void addInspect(CLI::App& app, Work& run)
{
    CLI::App* verb = app.add_subcommand("inspect", "Say what is in a pack");
    struct Options
    {
        std::string file;
        std::string format = "text";
        bool bounds = false;
        std::string animation;
        double time = 0;
    };
    auto options = std::make_shared<Options>();
    verb->add_option("FILE", options->file, "pack or part")->required();
    addFormat(*verb, options->format);
    verb->add_flag("--bounds", options->bounds,
                   "the boxes of all clusters of a pack in a pose, with --format json");
    const CLI::Option* animation = verb->add_option("--animation", options->animation,
                                                    "clip of the pose: its name, or its index if it has none")
                                       ->needs("--bounds");
    verb->add_option("--time", options->time, "seconds from the start of the clip")->needs("--animation");
    verb->footer("Examples:\n"
                 "  hearth inspect village.hearth --format json\n"
                 "  hearth inspect fox.hearth --bounds --animation Run --time 0.5 --format json");
    verb->callback(
        [options, animation, &run]
        {
            run = [options, animation]
            {
                if (!options->bounds)
                    return inspect(options->file, options->format);
                if (options->format != "json")
                    return usageError("--bounds needs --format json");
                if (!std::isfinite(options->time))
                    return usageError("--time must be a number");
                std::optional<command::ClipTime> clip;
                if (animation->count() > 0)
                    clip = command::ClipTime{options->animation, options->time};
                return printResult(command::boundsJson(options->file, clip));
            };
        });
}

void addVerify(CLI::App& app, Work& run)
{
    CLI::App* verb = app.add_subcommand("verify", "Check every byte of a pack, and what it means");
    struct Options
    {
        std::string file;
        std::string format = "text";
    };
    auto options = std::make_shared<Options>();
    verb->add_option("FILE", options->file, "pack or part")->required();
    addFormat(*verb, options->format);
    verb->footer("Example: hearth verify village.hearth");
    verb->callback(
        [options, &run]
        {
            run = [options]
            {
                const Result<std::string> result = command::verifyFile(options->file);
                if (options->format == "text")
                    return printResult(result);
                const int printed = printResult(command::verifyJson(options->file, result));
                return result.ok() ? printed : fail(result.error());
            };
        });
}

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
                                              ? command::extractBricks(options->file, options->output)
                                              : command::extractSpecular(options->file, options->output);
                    return status.ok() ? 0 : fail(status.error());
                }
                if (!(options->error >= 0) || !std::isfinite(options->error))
                    return usageError("--error must be a number from 0 on");
                if (!std::isfinite(options->time))
                    return usageError("--time must be a number");
                std::optional<command::ClipTime> clip;
                if (animation->count() > 0)
                    clip = command::ClipTime{options->animation, options->time};
                const Status status =
                    command::extractCut(options->file, options->mesh, options->error, clip, options->output);
                return status.ok() ? 0 : fail(status.error());
            };
        });
}

void addWhy(CLI::App& app, Work& run)
{
    CLI::App* verb = app.add_subcommand("why", "Say why cookers ran, and why they would run again");
    struct Options
    {
        std::string file;
        std::vector<std::string> caches;
    };
    auto options = std::make_shared<Options>();
    verb->add_option("FILE", options->file, "pack that was cooked here, or a source of one")->required();
    addCaches(*verb, options->caches);
    verb->footer("Example: hearth why village.hearth");
    verb->callback(
        [options, &run]
        { run = [options] { return printResult(command::why(options->file, options->caches)); }; });
}

void addCache(CLI::App& app, Work& run)
{
    CLI::App* verb = app.add_subcommand("cache", "Look after the cache of results");
    struct Options
    {
        std::string work;
        std::vector<std::string> caches;
        std::string limit;
    };
    auto options = std::make_shared<Options>();
    verb->add_option(
            "WORK", options->work,
            "stat: how full it is; gc: remove what was used least; verify: read every byte and remove what "
            "is damaged")
        ->required()
        ->check(CLI::IsMember({"stat", "gc", "verify"}));
    addCaches(*verb, options->caches);
    verb->add_option("--max-size", options->limit,
                     "gc: how much may stay, as 5G; the cache's limit by default")
        ->check(CLI::Validator(sizeFault, ""));
    verb->footer("Examples:\n"
                 "  hearth cache stat\n"
                 "  hearth cache gc --max-size 5G");
    verb->callback(
        [options, &run]
        {
            run = [options]
            {
                if (options->work == "stat")
                    return printResult(command::cacheStat(options->caches));
                if (options->work == "gc")
                {
                    std::optional<uint64_t> limit;
                    if (!options->limit.empty())
                        limit = cache::parseSize(options->limit, "").value();
                    return printResult(command::cacheGc(options->caches, limit));
                }
                const auto verified = command::cacheVerify(options->caches);
                if (!verified.ok())
                    return fail(verified.error());
                const int printed = printResult(verified->text);
                return verified->is_whole ? printed : 1;
            };
        });
}

void addExplain(CLI::App& app, Work& run)
{
    CLI::App* verb = app.add_subcommand("explain", "Say what the number of a message means");
    auto code = std::make_shared<std::string>();
    verb->add_option("CODE", *code, "as messages show it: E1203; none: list all");
    verb->footer("Example: hearth explain E1203");
    verb->callback([code, &run] { run = [code] { return printResult(command::explain(*code)); }; });
}

void addVersion(CLI::App& app, Work& run)
{
    CLI::App* verb = app.add_subcommand("version", "Print the version");
    verb->callback([&run] { run = [] { return printResult(std::string("hearth " HEARTH_VERSION "\n")); }; });
}

// ---- typing errors

/// The first word that no verb or option is called, with the nearest that is; empty where all are known.
std::string unknownWord(const CLI::App& app, const std::vector<std::string>& words)
{
    const auto describe = [](const std::string& kind, const std::string& word, const std::string& nearest)
    {
        return "unknown " + kind + " '" + word + "'" +
               (nearest.empty() ? std::string() : ": did you mean '" + nearest + "'?");
    };
    const CLI::App* verb = &app;
    for (const std::string& word : words)
    {
        const bool is_option = word.size() > 1 && word[0] == '-' && word.find_first_of("0123456789.") != 1;
        if (word == "--")
            break;
        if (is_option)
        {
            const std::string name = word.substr(0, word.find('='));
            // -j4 and -qv are short options with more in the same word
            const std::string shortened = name[1] == '-' ? name : name.substr(0, 2);
            if (verb->get_option_no_throw(shortened) != nullptr)
                continue;
            std::vector<std::string> names;
            for (const CLI::Option* option : verb->get_options())
                for (const std::string& long_name : option->get_lnames())
                    names.push_back("--" + long_name);
            return describe("option", name, tools::nearestMatch(name, names));
        }
        if (verb != &app)
            continue;
        std::vector<std::string> names;
        for (const CLI::App* known : app.get_subcommands(nullptr))
        {
            names.push_back(known->get_name());
            if (known->get_name() == word)
                verb = known;
        }
        if (verb == &app)
            return describe("verb", word, tools::nearestMatch(word, names));
    }
    return "";
}

std::string helpOf(const CLI::App& app)
{
    const auto chosen = app.get_subcommands();
    return chosen.empty() ? app.help() : chosen.front()->help("hearth") + "\n" + command::exitCodeTable();
}

int program(int argc, char** argv)
{
    CLI::App app("Cook assets into packs that a phone can stream and draw.", "hearth");
    Work run;
    app.require_subcommand(1);
    app.footer("Examples:\n"
               "  hearth cook house.glb -o house.hearth\n"
               "  hearth inspect house.hearth\n"
               "  hearth cook --help\n\n" +
               command::exitCodeTable());
    addCook(app, run);
    addInspect(app, run);
    addVerify(app, run);
    addExtract(app, run);
    addWhy(app, run);
    addCache(app, run);
    addExplain(app, run);
    addVersion(app, run);

    const std::string unknown = unknownWord(app, std::vector<std::string>(argv + 1, argv + argc));
    if (!unknown.empty())
        return usageError(unknown);
    try
    {
        app.parse(argc, argv);
    }
    catch (const CLI::CallForHelp&)
    {
        return printResult(helpOf(app));
    }
    catch (const CLI::ParseError& error)
    {
        return usageError(error.what());
    }
    return run();
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::runProgram("hearth", [&] { return program(argc, argv); });
}
