// hearth_measure_proxies: makes the proxies of models and checks what their parts state: manifolds by
// counting, distances by CGAL, bindings by their places. `./dev bench proxies` runs it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "cook/tools/child_processes.h"
#include "formats/base/program.h"
#include "tests/bench/aims.h"
#include "tests/bench/proxies/limited_distance.h"
#include "tests/support/proxies/proxy_check.h"
#include "tests/support/sandbox.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <sys/resource.h>

namespace
{

using namespace hearth;
using namespace hearth::test;
namespace fs = std::filesystem;

// Share of the diagonal up to which stored bounds are not told apart, as cook/proxy/README.md says.
constexpr double kEnough = 1e-4;

// CGAL's error, of the stored bound, and the least one, of the diagonal.
constexpr double kRelativeError = 0.03, kMinError = 2e-5;

struct Totals
{
    size_t models = 0, refused = 0, proxies = 0, sampled = 0;
    size_t no_manifolds = 0, beyond = 0, not_bound = 0;
    double looseness = 0; ///< the largest stored bound / certified distance
};

/// Figures of one model, for its row.
struct Row
{
    size_t proxies = 0, closed = 0, bindings = 0;
    uint64_t mesh_triangles = 0, triangles = 0;
    double distance = 0;  ///< the largest stored bound, over the diagonal
    double looseness = 0; ///< the largest stored bound / certified distance; 0: all are below kEnough
    size_t stride = 1;    ///< the largest
    std::vector<std::string> faults;
};

/// Return the seconds of processor that ended child processes took.
double childSeconds()
{
    rusage usage{};
    ::getrusage(RUSAGE_CHILDREN, &usage);
    const auto seconds = [](const timeval& time)
    { return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec); };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Run a cooker in the folder. Print its first message if it refuses.
bool run(Sandbox& folder, std::vector<std::string> words)
{
    words.front() = tools::programFolder() + "/" + words.front();
    const ProgramEnd end = folder.run(words);
    if (end.exit_code != 0)
        fmt::print("{}: exit code {}: {}", words.front(), end.exit_code, end.err);
    return end.exit_code == 0;
}

/// Compare a stored bound with the distance that CGAL certifies.
void checkBound(const std::string& name, double stored, const TriangleSurface& from,
                const TriangleSurface& to, const CheckedProxy& proxy, unsigned seconds, Row& row,
                Totals& totals)
{
    const double diagonal = proxy.diagonal();
    const double error = std::max(kRelativeError * stored, kMinError * diagonal);
    const auto measured = bench::measureDistance(from, to, error, seconds);
    row.distance = std::max(row.distance, stored / diagonal);
    row.stride = std::max(row.stride, measured ? measured->stride : SIZE_MAX);
    if (!measured)
        return;
    if (measured->distance - error > stored + proxy.rounding())
    {
        ++totals.beyond;
        row.faults.push_back(fmt::format("{} is {}, stored {}", name, measured->distance, stored));
    }
    // neither tells apart what the floats of the positions do not
    const double enough = std::max(kEnough * diagonal, 4 * proxy.rounding());
    if (measured->stride == 1 && stored > 1.01 * enough)
    {
        const double looseness = stored / std::max(measured->distance, enough);
        row.looseness = std::max(row.looseness, looseness);
    }
}

Status checkProxy(const ProxyParts& parts, size_t number, unsigned seconds, Row& row, Totals& totals)
{
    HEARTH_ASSIGN_OR_RETURN(const CheckedProxy proxy, readProxy(parts, number));
    ++row.proxies;
    row.closed += proxy.record.is_closed;
    row.mesh_triangles += proxy.mesh.triangleCount();
    row.triangles += proxy.surface.triangles.size() / 3;
    row.bindings += proxy.bindings.size();
    const std::string name = fmt::format("proxy {}", number);
    if (const std::string defect = findShapeDefect(proxy); !defect.empty())
    {
        ++totals.no_manifolds;
        row.faults.push_back(name + ": " + defect);
    }
    HEARTH_ASSIGN_OR_RETURN(const std::string defect, findBindingDefect(parts, proxy));
    if (!defect.empty())
    {
        ++totals.not_bound;
        row.faults.push_back(name + ": " + defect);
    }
    checkBound(name + ": its distance to the mesh", double{proxy.record.distance}, proxy.surface,
               proxy.meshSurface(), proxy, seconds, row, totals);
    checkBound(name + ": the mesh's distance to it", double{proxy.record.mesh_distance}, proxy.meshSurface(),
               proxy.surface, proxy, seconds, row, totals);
    return success();
}

void print(const std::string& name, const Row& row, double seconds, uint64_t bytes)
{
    std::string notes;
    if (row.stride == SIZE_MAX)
        notes = ", not certified";
    else if (row.stride > 1)
        notes = fmt::format(", 1 of {} triangles", row.stride);
    fmt::print("| {} | {} | {} | {:.2f} | {:.1f} | {} of {} | {:.5f} | {} | {} |\n", name, row.mesh_triangles,
               row.triangles, seconds, static_cast<double>(bytes) / 1024, row.closed, row.proxies,
               row.distance, (row.looseness > 0 ? fmt::format("{:.3f}", row.looseness) : "-") + notes,
               row.bindings);
    for (const std::string& fault : row.faults)
        fmt::print("  FAULT: {}\n", fault);
    std::fflush(stdout); // it takes long
}

/// Measure a model: all its distances together get about `seconds` of processor.
Status measureModel(const std::string& source, unsigned seconds, Totals& totals)
{
    Sandbox folder;
    ++totals.models;
    if (!run(folder, {"hearth-import", source, "-o", "a.import.part"}) ||
        !run(folder, {"hearth-clusters", "a.import.part", "-o", "a.clusters.part"}))
    {
        ++totals.refused;
        return success();
    }
    const double begin = childSeconds();
    if (!run(folder,
             {"hearth-proxy", "a.import.part", "a.clusters.part", "-o", "a.proxy.part", "--bindings"}))
        return Error{Issue::child_failed, source, "", "hearth-proxy refuses it"};
    const double proxy_seconds = childSeconds() - begin;
    HEARTH_ASSIGN_OR_RETURN(const ProxyParts parts, openProxyParts(folder / "a"));
    const size_t count = parts.proxy_part.proxies().size();
    const unsigned limit = std::max(1u, seconds / static_cast<unsigned>(2 * std::max<size_t>(count, 1)));
    Row row;
    for (size_t i = 0; i < count; ++i)
        HEARTH_TRY(checkProxy(parts, i, limit, row, totals));
    totals.proxies += row.proxies;
    totals.sampled += row.stride > 1 ? 1 : 0;
    totals.looseness = std::max(totals.looseness, row.looseness);
    const fs::path path(source);
    print((path.parent_path().filename() / path.filename()).string(), row, proxy_seconds,
          fs::file_size(folder / "a.proxy.part"));
    return success();
}

int judge(const Totals& totals)
{
    fmt::print("{} models, {} of them refused, {} certified on samples; {} proxies, bounds at most {:.3f} "
               "times what is certified\n",
               totals.models, totals.refused, totals.sampled, totals.proxies, totals.looseness);
    bench::Judgement judgement("proxies");
    judgement.record("proxies that are no manifold, or not closed as stored",
                     static_cast<double>(totals.no_manifolds));
    judgement.record("distances beyond their stored bound", static_cast<double>(totals.beyond));
    judgement.record("proxies with a vertex that is not bound", static_cast<double>(totals.not_bound));
    judgement.record("largest stored bound / certified distance", totals.looseness);
    return judgement.finish();
}

int program(int argc, char** argv)
{
    cli::CommandLine app(
        "Makes proxies of models, by the default settings, and checks what their parts state.");
    std::vector<std::string> sources;
    unsigned seconds = 60;
    app.addOption("source", sources, "models").required();
    app.addOption("--seconds", seconds,
                  "processor time for the distances of a model; where they take longer, of a sample")
        .range(1u, 100'000u)
        .showDefault();
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    fmt::print(
        "| model | triangles | of proxies | s | KiB | closed | distance / diagonal | stored / certified | "
        "bindings |\n|---|---:|---:|---:|---:|---:|---:|---:|---:|\n");
    Totals totals;
    for (const std::string& source : sources)
        if (const Status measured = measureModel(fs::absolute(source).string(), seconds, totals);
            !measured.ok())
            return reportFailure(measured.error());
    return judge(totals);
}

} // namespace

int main(int argc, char** argv)
{
    return runProgram("hearth_measure_proxies", [&] { return program(argc, argv); });
}
