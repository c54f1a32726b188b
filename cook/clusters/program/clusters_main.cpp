// hearth-clusters: builds the cluster hierarchies of an import part, or a source, and writes the clusters
// part.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/program/cluster_part.h"
#include "cook/clusters/program/debug_mesh.h"
#include "cook/clusters/program/profile.h"
#include "cook/clusters/program/source_part.h"
#include "cook/clusters/program/statistics.h"
#include "cook/command_line/command_line.h"
#include "cook/command_line/thread_limit.h"
#include "cook/tools/batch.h"
#include "formats/base/atomic_file.h"
#include "formats/base/program.h"
#include "formats/base/text.h"

#include <cstdio>
#include <fmt/format.h>
#include <malloc.h>
#include <string>

namespace
{

using namespace hearth;

struct Arguments
{
    std::string input;
    std::string output;
    std::vector<std::string> lods;
    size_t jobs = 0;
    std::string profile;
    std::vector<std::string> settings;
    std::string statistics;
    bool statistics_with_times = false;
    bool statistics_without_discrete_lods = false;
    bool visibility = false;
    uint32_t debug_mesh = 0;
    uint32_t debug_level = 0;
    std::string debug_output;
};

void printWarning(const Arguments& arguments, std::string detail)
{
    const Error warning{Issue::degraded, arguments.input, "", std::move(detail)};
    std::fprintf(stderr, "%s\n", formatMessage(warning).c_str());
}

std::string displacementText(std::optional<double> metres)
{
    return metres ? fmt::format("up to {:.3g} m", *metres) : std::string("at any distance");
}

void printWarnings(const Arguments& arguments, std::span<const clusters::MeshStatistics> meshes)
{
    uint64_t stuck_groups = 0;
    for (const clusters::MeshStatistics& mesh : meshes)
    {
        stuck_groups += mesh.counts.stuck_groups;
        for (const clusters::TargetStatistics& target : mesh.targets)
            if (!target.met())
                printWarning(arguments,
                             fmt::format("mesh {} '{}' has no {} triangles at level {}, but {}", mesh.index,
                                         mesh.name, target.wanted, target.level,
                                         target.triangles ? std::to_string(*target.triangles)
                                                          : fmt::format("{} levels", mesh.levels.size())));
    }
    for (const clusters::MeshStatistics& mesh : meshes)
        if (const uint32_t vertices = mesh.counts.influence_loss.vertex_count; vertices > 0)
            printWarning(
                arguments,
                fmt::format("mesh {} '{}' loses the least influences of {} vertices, which are then {} "
                            "from where these would carry them",
                            mesh.index, mesh.name, vertices,
                            displacementText(mesh.counts.influence_displacement)));
    for (const clusters::MeshStatistics& mesh : meshes)
        for (size_t i = 0; i < mesh.authored_levels.size(); ++i)
            if (mesh.authored_levels[i] == kInvalidIndex)
                printWarning(arguments,
                             fmt::format("authored level {} of mesh {} '{}' is left out: it has not fewer "
                                         "triangles than what it would replace, or none",
                                         i + 1, mesh.index, mesh.name));
    if (stuck_groups != 0)
        printWarning(arguments,
                     std::to_string(stuck_groups) +
                         " groups of clusters cannot be simplified further and are drawn at any distance");
}

/// Errors: usage if the options refer to something that the part does not have.
Status checkArguments(const Arguments& arguments, const formats::ContainerReader& part)
{
    if (arguments.debug_output.empty())
        return success();
    if (!clusters::isDebugMeshPath(arguments.debug_output))
        return Error{Issue::usage, arguments.debug_output, "", "--debug-output must end in .ply or .obj"};
    if (const uint32_t count = clusters::meshCount(part); arguments.debug_mesh >= count)
        return Error{Issue::usage, arguments.input, "",
                     "there is no mesh " + std::to_string(arguments.debug_mesh) + ": the source has " +
                         std::to_string(count)};
    return success();
}

Status writeStatistics(const Arguments& arguments, std::span<const clusters::MeshStatistics> meshes)
{
    const std::string source = arguments.input.substr(arguments.input.rfind('/') + 1); // npos + 1 is 0
    return writeText(arguments.statistics, clusters::statisticsJson(source, meshes));
}

Status cook(const Arguments& arguments, const clusters::Profile& profile,
            const formats::ContainerReader& part)
{
    HEARTH_TRY(checkArguments(arguments, part));
    std::vector<std::string> materials;
    if (!profile.materials.empty())
    {
        HEARTH_ASSIGN_OR_RETURN(materials, clusters::materialNames(part));
    }
    const auto configure = [&](const std::string& name)
    {
        clusters::Config config = clusters::resolveConfig(profile, name, materials);
        config.visibility = arguments.visibility;
        return config;
    };
    std::vector<clusters::MeshStatistics> meshes;
    const auto observe = [&](uint32_t index, const clusters::BuiltMesh& mesh) -> Status
    {
        const clusters::Hierarchy& hierarchy = mesh.hierarchy;
        meshes.push_back(clusters::collectStatistics(hierarchy, mesh.config, index, mesh.name));
        if (arguments.statistics_with_times)
            meshes.back().seconds = mesh.seconds;
        if (!arguments.statistics.empty() && !arguments.statistics_without_discrete_lods)
            meshes.back().discrete_lods = {clusters::measureDiscreteLods(hierarchy),
                                           clusters::storedBytes(hierarchy)};
        if (!arguments.debug_output.empty() && index == arguments.debug_mesh)
            HEARTH_TRY(clusters::writeDebugMesh(hierarchy, arguments.debug_level, arguments.debug_output));
        return success();
    };
    HEARTH_TRY(clusters::writeClustersPart(part, arguments.output, configure, observe));
    printWarnings(arguments, meshes);
    return arguments.statistics.empty() ? success() : writeStatistics(arguments, meshes);
}

Result<clusters::Profile> loadProfile(const Arguments& arguments)
{
    if (!arguments.profile.empty())
        return clusters::readProfile(arguments.profile);
    return clusters::parseProfile(joinLines(arguments.settings), "--set");
}

int run(const Arguments& arguments)
{
    const cli::ThreadLimit limit(arguments.jobs);
    const Result<clusters::Profile> profile = loadProfile(arguments);
    if (!profile.ok())
        return reportFailure(profile.error());
    const clusters::SourcePart source = clusters::openSourcePart(
        arguments.input, {arguments.lods, arguments.profile, arguments.settings}, arguments.output);
    if (!source.part)
        return source.exit_code;
    const Status status = cook(arguments, *profile, *source.part);
    return status.ok() ? 0 : reportFailure(status.error());
}

int program(int argc, char** argv)
{
    cli::CommandLine app("Builds the cluster hierarchy of every mesh and writes the clusters part.");
    Arguments arguments;
    app.addOption("source", arguments.input, "import part, or any source that hearth-import reads")
        .required();
    app.addOption("-o,--output", arguments.output, "clusters part to write").required();
    app.addOption(
           "--lod", arguments.lods,
           "N=FILE: level of detail N of the source's only mesh, made by hand; not with an import part")
        .oneValueEach();
    app.addOption("-j,--jobs", arguments.jobs, "threads to use; the result does not depend on it");
    const cli::Option profile =
        app.addOption("--profile", arguments.profile,
                      "TOML file that says how far each level is simplified; see cook/clusters/README.md");
    app.addOption("--set", arguments.settings, "KEY=VALUE: a line of a profile, as clusters.normal_bits=16")
        .oneValueEach()
        .excludes(profile);
    app.addFlag("--visibility", arguments.visibility,
                "give vertices with normals a visibility, open until hearth-visibility bakes it");
    const cli::Option statistics = app.addOption(
        "--stats", arguments.statistics, "write statistics of each mesh as JSON; - is standard output");
    app.addFlag("--stats-times", arguments.statistics_with_times,
                "add the seconds that each mesh took, which differ from run to run")
        .needs(statistics);
    app.addFlag("--no-discrete-lods", arguments.statistics_without_discrete_lods,
                "leave out what levels by hand would take, which is a third of the time of small meshes")
        .needs(statistics);
    const cli::Option debug =
        app.addOption("--debug-output", arguments.debug_output,
                      "write the clusters of one level as .ply (coloured) or .obj (grouped)");
    app.addOption("--debug-mesh", arguments.debug_mesh, "index of the mesh").needs(debug).showDefault();
    app.addOption("--debug-level", arguments.debug_level, "its level; 0 is the source")
        .needs(debug)
        .showDefault();
    app.setFooter(
        "Examples:\n"
        "  hearth-clusters scene.import.part -o scene.clusters.part\n"
        "  hearth-clusters rock.glb -o rock.part --stats - --debug-level 3 --debug-output rock3.ply\n"
        "Exit codes: 0 done, 2 usage, 65 malformed input, 66 input missing, 70 internal, 73 cannot write, "
        "74 I/O, 78 wrong settings, 130 interrupted");
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    return run(arguments);
}

} // namespace

int main(int argc, char** argv)
{
#ifdef __GLIBC__
    // return large arrays to the system when they are freed, whatever was allocated behind them
    ::mallopt(M_MMAP_THRESHOLD, 1 << 22);
#endif
    return hearth::tools::runCooker("hearth-clusters", argc, argv, program);
}
