// hearth-bricks: cooks the bricks of one or more sources, or marches rays through the bricks of a file.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/light/brick_need.h"
#include "cook/bricks/light/emission.h"
#include "cook/bricks/light/march_csv.h"
#include "cook/bricks/light/reflectors.h"
#include "cook/bricks/light/scene_light.h"
#include "cook/bricks/light/settled_light.h"
#include "cook/bricks/voxels/scene_sky.h"
#include "cook/bricks/voxels/source_parts.h"
#include "cook/command_line/command_line.h"
#include "cook/command_line/thread_limit.h"
#include "formats/base/atomic_file.h"
#include "formats/base/program.h"
#include "formats/scene/scene_lighting.h"

#include <chrono>
#include <cstdio>

namespace
{

using namespace hearth;
using namespace hearth::bricks;

struct Arguments
{
    std::vector<std::string> inputs; ///< parts, or with `rays` the file to march through
    std::string output;
    std::string rays;
    std::vector<std::string> proxies;
    std::string probe; ///< part with the probe of the sky, or empty
    std::string statistics;
    double voxel_size = 0;
    std::vector<double> min, max;
    std::vector<std::vector<double>> seeds;
    bool only_if_needed = false;
    GridSettings settings;
    size_t jobs = 0;
};

/// Print one line on excluded instances and one on dropped bricks.
void warn(const GridStatistics& statistics, const std::string& output)
{
    const auto print = [&](const std::string& detail) {
        std::fprintf(stderr, "%s\n", formatMessage({Issue::dropped, output, "", detail}).c_str());
    };
    if (statistics.left_out.animated + statistics.left_out.deformed > 0)
        print(std::to_string(statistics.left_out.animated) + " moving and " +
              std::to_string(statistics.left_out.deformed) + " deformed instances have no bricks");
    if (statistics.leaks.loose_surfaces > 0)
        print(std::to_string(statistics.leaks.loose_surfaces) + " of " +
              std::to_string(statistics.leaks.surfaces) +
              " closed proxies close no gaps: they are more than four voxels away from their meshes");
    if (statistics.dropped.bricks > 0)
    {
        char distance[32];
        std::snprintf(distance, sizeof(distance), "%.4g", statistics.dropped.from_distance);
        print(std::to_string(statistics.dropped.bricks) + " of " +
              std::to_string(statistics.dropped.bricks + statistics.bricks) +
              " bricks do not fit the memory: those from " + distance + " m on from what matters" +
              (statistics.dropped.tiles > 0 ? "; " + std::to_string(statistics.dropped.tiles) +
                                                  " tiles farther away were not looked at"
                                            : ""));
    }
}

double secondsSince(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Set the emission of the faces, and the light that they have under the scene's own lights.
Status lightGrid(const StaticScene& scene, const SceneSky& sky, CookedGrid& grid)
{
    auto start = std::chrono::steady_clock::now();
    HEARTH_TRY(traceEmission(scene, grid));
    grid.statistics.emission_seconds = secondsSince(start);
    start = std::chrono::steady_clock::now();
    HEARTH_ASSIGN_OR_RETURN(grid.tables.reflectors,
                            findReflectors(scene, grid.statistics.frame, grid.statistics.error));
    shared::SceneLighting lighting = makeSceneLighting(scene, sky.probes());
    shared::addReflectors(lighting, grid.tables.reflectors);
    SettledLight light = settleLight(makeBrickView(grid.tables), lighting);
    grid.tables.lighting = std::move(light.codes);
    grid.statistics.light_sweeps = light.sweeps;
    grid.statistics.light_seconds = secondsSince(start);
    return success();
}

Status cookNoGrid(const Arguments& arguments, const std::string& reason)
{
    HEARTH_TRY(writePartWithoutGrid(arguments.output, reason));
    return arguments.statistics.empty() ? success()
                                        : writeText(arguments.statistics, statisticsWithoutGrid(reason));
}

Status cook(const Arguments& arguments)
{
    std::vector<tools::PartOfSource> proxies;
    for (const std::string& text : arguments.proxies)
    {
        HEARTH_ASSIGN_OR_RETURN(
            tools::PartOfSource proxy,
            tools::parsePartOfSource(text, arguments.inputs.size() / 3, "hearth-bricks", "--proxies"));
        proxies.push_back(std::move(proxy));
    }
    HEARTH_ASSIGN_OR_RETURN(const std::vector<SourceParts> sources, openSources(arguments.inputs, proxies));
    HEARTH_ASSIGN_OR_RETURN(const StaticScene scene, collectStaticScene(sources));
    HEARTH_ASSIGN_OR_RETURN(const SceneSky sky, SceneSky::open(scene, arguments.probe));
    if (arguments.only_if_needed)
    {
        HEARTH_ASSIGN_OR_RETURN(const std::string reason, findReasonForNoBricks(scene, arguments.settings));
        if (!reason.empty())
            return cookNoGrid(arguments, reason);
    }
    HEARTH_ASSIGN_OR_RETURN(CookedGrid grid, cookGrid(scene, arguments.settings));
    HEARTH_TRY(lightGrid(scene, sky, grid));
    HEARTH_TRY(writeGridPart(arguments.output, grid));
    warn(grid.statistics, arguments.output);
    if (arguments.statistics.empty())
        return success();
    if (arguments.statistics != "-")
        HEARTH_TRY(writeText("-", memoryText(grid.statistics)));
    return writeText(arguments.statistics, statisticsJson(grid.statistics));
}

int run(const Arguments& arguments)
{
    const cli::ThreadLimit limit(arguments.jobs);
    const Status done = arguments.rays.empty()
                            ? cook(arguments)
                            : marchCsvFile(arguments.inputs[0], arguments.rays, arguments.output);
    return done.ok() ? 0 : reportFailure(done.error());
}

Double3 point(const std::vector<double>& values)
{
    return {values[0], values[1], values[2]};
}

/// Return the error message for options that exclude each other; empty if the options are valid.
std::string checkArguments(const Arguments& arguments)
{
    if (!arguments.rays.empty() && arguments.inputs.size() != 1)
        return "--march: one pack or bricks part is needed";
    if (arguments.rays.empty() && arguments.inputs.size() % 3 != 0)
        return "PARTS: three parts are needed for each source";
    return "";
}

void fillSettings(Arguments& arguments, bool has_voxel_size)
{
    GridSettings& settings = arguments.settings;
    if (has_voxel_size)
        settings.voxel_size = arguments.voxel_size;
    if (!arguments.min.empty())
        settings.min = point(arguments.min);
    if (!arguments.max.empty())
        settings.max = point(arguments.max);
    for (const std::vector<double>& seed : arguments.seeds)
        settings.seeds.push_back(narrow(point(seed)));
}

void addOptions(cli::CommandLine& app, Arguments& arguments)
{
    app.addOption("PARTS", arguments.inputs,
                  "import, clusters and textures part of each source; with --march one pack or bricks part")
        .required();
    app.addOption("-o,--output", arguments.output,
                  "bricks part to write; with --march the CSV file, - is standard output")
        .required();
    const cli::Option voxel_size = app.addOption(
        "--voxel-size", arguments.voxel_size,
        "metres; by default about 512 voxels along the longest side, 0.1 m at least where that makes 64, and "
        "more where the memory asks for it");
    const auto addPoint = [&app](const char* name, auto& values, const char* what)
    { return app.addOption(name, values, what).delimiter(',').expected(3).typeName("X,Y,Z"); };
    const cli::Option min = addPoint(
        "--min", arguments.min, "least corner of the grid, metres; by default around the static geometry");
    const cli::Option max = addPoint("--max", arguments.max, "its greatest corner");
    const cli::Option seed = addPoint(
        "--seed", arguments.seeds,
        "a place that is seen from, as cameras are: what is sealed off from all of them has no faces; may "
        "be given again");
    const cli::Option memory =
        app.addOption(
               "--memory", arguments.settings.memory,
               "bytes that the grid may take on the GPU, 20971520 by default; farther bricks are dropped")
            .range(uint64_t{1}, uint64_t{1} << 40, "BYTES");
    const cli::Option error =
        app.addOption("--error", arguments.settings.error_share,
                      "how far clusters may be off, in voxels; 0.25 by default, 0: the finest triangles")
            .range(0.0, 16.0, "FLOAT");
    const cli::Option only_if_needed = app.addFlag("--if-needed", arguments.only_if_needed,
                                                   "write a part without bricks unless more than a quarter "
                                                   "of 4096 points on surfaces, or more than half of "
                                                   "the cameras, see less than a tenth of the sky");
    const cli::Option statistics =
        app.addOption("--stats", arguments.statistics,
                      "write statistics of the scene as JSON, and print the memory; - is standard output");
    const cli::Option probe = app.addOption(
        "--probe", arguments.probe,
        "probe part of the sky that lights the scene; else that of a source, or the default sky");
    const cli::Option proxies =
        app.addOption("--proxies", arguments.proxies,
                      "N=PART: proxy part of source N, counted from 0; no light leaks into its closed "
                      "proxies through gaps of their meshes; once for each source that has one")
            .oneValueEach();
    const cli::Option jobs =
        app.addOption("-j,--jobs", arguments.jobs, "threads to use; the result does not depend on it");
    cli::Option march = app.addOption(
        "--march", arguments.rays,
        "CSV file of origin_x,origin_y,origin_z,direction_x,direction_y,direction_z in metres: write "
        "hit,x,y,z,face,t for each ray: 1, the first solid voxel, the face by which it is entered (none "
        "where the ray starts inside) and the distance in metres; 0,,,,, where it meets none");
    for (const cli::Option& option :
         {voxel_size, min, max, seed, memory, error, only_if_needed, statistics, probe, proxies, jobs})
        march.excludes(option);
    app.setFooter(
        "Examples:\n"
        "  hearth-bricks room.import.part room.clusters.part room.textures.part -o room.bricks.part\n"
        "  hearth-bricks village.hearth --march rays.csv -o hits.csv\n"
        "Exit codes: 0 done, 2 usage, 65 malformed input, 66 input missing, 70 internal, 73 cannot write, "
        "74 I/O");
    app.setCheck([&arguments] { return checkArguments(arguments); });
    app.setAction([&arguments, voxel_size] { fillSettings(arguments, voxel_size.count() > 0); });
}

int program(int argc, char** argv)
{
    cli::CommandLine app(
        "Voxelises the static geometry of a scene into bricks; or marches rays through bricks.",
        "hearth-bricks");
    Arguments arguments;
    addOptions(app, arguments);
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    return run(arguments);
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::runProgram("hearth-bricks", [&] { return program(argc, argv); });
}
