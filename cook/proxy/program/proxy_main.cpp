// hearth-proxy: reads an import part and its clusters part, and writes the proxy part.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "cook/command_line/thread_limit.h"
#include "cook/proxy/program/proxy_part.h"
#include "cook/tools/batch.h"
#include "cook/tools/open_part.h"
#include "formats/base/atomic_file.h"
#include "formats/base/program.h"

#include <optional>

namespace
{

using namespace hearth;

struct Arguments
{
    std::string import_part;
    std::string clusters_part;
    std::string wrap_part;
    std::string output;
    std::string statistics;
    proxy::ProxySettings settings;
    uint32_t convex_parts = 0;
    double convex_error = proxy::ConvexSettings{}.error;
    size_t jobs = 0;
};

Status writeStatistics(const Arguments& arguments, const std::vector<proxy::MeshStatistics>& meshes)
{
    const std::string source =
        arguments.import_part.substr(arguments.import_part.rfind('/') + 1); // npos + 1 is 0
    return writeText(arguments.statistics, proxy::statisticsJson(source, meshes));
}

Status cook(const Arguments& arguments)
{
    HEARTH_ASSIGN_OR_RETURN(const formats::PackView import_part, tools::openPart(arguments.import_part));
    HEARTH_ASSIGN_OR_RETURN(const formats::PackView clusters_part, tools::openPart(arguments.clusters_part));
    std::optional<formats::PackView> wrap_part;
    if (!arguments.wrap_part.empty())
    {
        HEARTH_ASSIGN_OR_RETURN(wrap_part, tools::openPart(arguments.wrap_part));
    }
    HEARTH_ASSIGN_OR_RETURN(const std::vector<proxy::MeshStatistics> meshes,
                            proxy::writeProxyPart(import_part, clusters_part,
                                                  wrap_part ? &*wrap_part : nullptr, arguments.output,
                                                  arguments.settings));
    return arguments.statistics.empty() ? success() : writeStatistics(arguments, meshes);
}

int run(const Arguments& arguments)
{
    const cli::ThreadLimit limit(arguments.jobs);
    const Status cooked = cook(arguments);
    return cooked.ok() ? 0 : reportFailure(cooked.error());
}

int program(int argc, char** argv)
{
    cli::CommandLine app(
        "Makes simple, clean meshes that stand for the meshes of a source, for collision, as "
        "occluders and shadow casters, and writes the proxy part.");
    Arguments arguments;
    bool is_authored = false;
    app.addOption("import", arguments.import_part, "import part").required();
    app.addOption("clusters", arguments.clusters_part, "clusters part of the same source").required();
    app.addOption(
        "wrap", arguments.wrap_part,
        "wrap part of the same source: its closed surfaces become the proxies, in place of cleaned cuts");
    app.addOption("-o,--output", arguments.output, "proxy part to write").required();
    app.addOption(
           "--error", arguments.settings.error,
           "error of the cut that a proxy is made from, over the diagonal of the mesh's box; 0: the whole "
           "mesh")
        .range(0.0, 1.0, "SHARE")
        .showDefault();
    app.addOption("--triangles", arguments.settings.triangles,
                  "triangles of that cut, at most; no limit by default")
        .range(uint64_t{1}, uint64_t{1} << 32, "COUNT");
    app.addOption("--holes", arguments.settings.hole_length,
                  "holes are filled whose boundary is at most this long, over the diagonal; 0: none")
        .range(0.0, 16.0, "SHARE")
        .showDefault();
    app.addOption("--convex-parts", arguments.convex_parts,
                  "make convex parts of it, for physics, at most that many; 0: it stays as it is")
        .range(uint32_t{0}, uint32_t{1024}, "COUNT")
        .showDefault();
    app.addOption("--convex-error", arguments.convex_error,
                  "convex parts are made while they reach farther than this from the mesh, over the diagonal")
        .range(0.0, 1.0, "SHARE")
        .showDefault();
    app.addFlag("--bindings", arguments.settings.binds_vertices,
                "store where the mesh's vertices are on its proxy");
    app.addFlag("--authored", is_authored,
                "take the proxies that artists made, which the import part has, and make none");
    app.addOption("-j,--jobs", arguments.jobs, "threads to use; the result does not depend on it");
    app.addOption("--stats", arguments.statistics,
                  "write statistics of each mesh as JSON; - is standard output");
    app.setFooter("Example: hearth-proxy rock.import.part rock.clusters.part -o rock.proxy.part --stats -\n"
                  "Exit codes: 0 done, 2 usage, 65 malformed input, 66 input missing, 70 internal, 73 cannot "
                  "write, 74 I/O");
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    if (arguments.convex_parts > 0)
        arguments.settings.convex = {arguments.convex_parts, arguments.convex_error};
    arguments.settings.makes_missing = !is_authored;
    return run(arguments);
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::tools::runCooker("hearth-proxy", argc, argv, program);
}
