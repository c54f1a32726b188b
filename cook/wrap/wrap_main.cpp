// hearth-wrap: wraps each mesh of an import part into a watertight one, or lists where meshes intersect
// themselves.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "cook/command_line/thread_limit.h"
#include "cook/json/json.h"
#include "cook/tools/batch.h"
#include "cook/wrap/wrap_part.h"
#include "formats/base/atomic_file.h"
#include "formats/base/program.h"

#include <cstdio>
#include <sys/resource.h>

namespace
{

using namespace hearth;

struct Arguments
{
    std::string input;
    std::string output;
    std::string statistics;
    std::string self_intersections;
    size_t jobs = 0;
    uint64_t max_memory_mib = 4096;
    wrap::WrapOptions options;
};

/// Limit the memory of this process: an allocation beyond it throws.
void limitMemory(uint64_t mib)
{
#ifdef HEARTH_LIMITS_MEMORY
    rlimit limit{};
    ::getrlimit(RLIMIT_AS, &limit);
    limit.rlim_cur = std::min<rlim_t>(mib << 20, limit.rlim_max);
    ::setrlimit(RLIMIT_AS, &limit);
#else
    static_cast<void>(mib);
#endif
}

std::string statisticsJson(const std::vector<wrap::WrapStatistics>& meshes)
{
    Json list = Json::array();
    for (const wrap::WrapStatistics& mesh : meshes)
        list.push_back({{"name", mesh.name},
                        {"source_triangles", mesh.source_triangles},
                        {"triangles", mesh.triangles},
                        {"cpu_seconds", mesh.seconds}});
    return Json{{"schema", "hearth.wrap/1"}, {"meshes", std::move(list)}}.dump(1) + "\n";
}

Status cook(const Arguments& arguments)
{
    HEARTH_ASSIGN_OR_RETURN(const std::vector<wrap::WrapStatistics> meshes,
                            wrap::wrapPart(arguments.input, arguments.output, arguments.options));
    for (uint32_t i = 0; i < meshes.size(); ++i)
        if (meshes[i].triangles == 0 && meshes[i].source_triangles > 0)
        {
            const Error warning{Issue::dropped, arguments.input, wrap::meshText(i, meshes[i].name),
                                "no triangle has an area: its wrap is empty"};
            std::fprintf(stderr, "%s\n", formatMessage(warning).c_str());
        }
    return arguments.statistics.empty() ? success() : writeText(arguments.statistics, statisticsJson(meshes));
}

Status findIntersections(const Arguments& arguments)
{
    HEARTH_ASSIGN_OR_RETURN(const std::string text,
                            wrap::describeSelfIntersections(arguments.input, arguments.options.max_seconds));
    return writeText(arguments.self_intersections, text);
}

int run(const Arguments& arguments)
{
    limitMemory(arguments.max_memory_mib);
    const cli::ThreadLimit limit(arguments.jobs);
    const Status done = arguments.self_intersections.empty() ? cook(arguments) : findIntersections(arguments);
    return done.ok() ? 0 : reportFailure(done.error());
}

int program(int argc, char** argv)
{
    cli::CommandLine app("Wraps each mesh of an import part into a watertight one around it.");
    Arguments arguments;
    app.addOption("part", arguments.input, "import part").required();
    auto output = app.addOption("-o,--output", arguments.output, "part to write: the wrapped meshes");
    app.addOption("--alpha", arguments.options.alpha,
                  "radius of the largest hole that is closed, a fraction of each mesh's diagonal")
        .range(0.0005, 1.0, "FRACTION")
        .showDefault();
    app.addOption("--offset", arguments.options.offset,
                  "distance from the source, a fraction of each mesh's diagonal")
        .range(0.00001, 1.0, "FRACTION")
        .showDefault();
    app.addOption("--error", arguments.options.error,
                  "how far decimation may move the wrap, a fraction of each mesh's diagonal; 0: not at all")
        .range(0.0, 1.0, "FRACTION")
        .showDefault();
    app.addOption("--triangles", arguments.options.triangles,
                  "triangles that decimation aims at, at most; no limit by default")
        .range(uint64_t{1}, uint64_t{1} << 32, "COUNT");
    app.addOption("-j,--jobs", arguments.jobs, "threads to use; the result does not depend on it");
    app.addOption("--max-memory", arguments.max_memory_mib, "MiB of memory that the process may use")
        .range(uint64_t{64}, uint64_t{1} << 24, "MIB")
        .showDefault();
    app.addOption("--max-seconds", arguments.options.max_seconds,
                  "processor time that one mesh may take; with --self-intersections, all together")
        .positive("SECONDS")
        .showDefault();
    app.addOption("--stats", arguments.statistics,
                  "write statistics of each mesh as JSON; - is standard output")
        .needs(output);
    app.addOption("--self-intersections", arguments.self_intersections,
                  "instead, write as JSON which triangles of each mesh intersect; - is standard output")
        .excludes(output);
    app.setCheck(
        [&]
        {
            return arguments.output.empty() && arguments.self_intersections.empty()
                       ? std::string("--output or --self-intersections is required")
                       : std::string();
        });
    app.setFooter(
        "Example: hearth-wrap car.import.part -o car.wrap.part --alpha 0.01\n"
        "Exit codes: 0 done, 2 usage, 65 malformed input or a mesh beyond the limits, 66 input missing, "
        "70 internal, 73 cannot write, 74 I/O");
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    return run(arguments);
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::tools::runCooker("hearth-wrap", argc, argv, program);
}
