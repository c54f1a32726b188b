// Measures stored errors of whole meshes against certified distances, and how far levels leave the box of
// their source. Fails where an error is no bound, where a level leaves the box, or where the errors of
// generated meshes are loose. `./dev bench error` runs it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "cook/mesh/source_mesh.h"
#include "formats/base/program.h"
#include "formats/pack/pack_view.h"
#include "tests/support/cut_errors.h"
#include "tests/support/cuts.h"
#include "tests/support/shapes.h"
#include "tests/support/surfaces/cgal_distance.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>
#include <optional>

namespace
{

using namespace hearth;

// Aims. The first is what docs claim of the median; the second is part of the diagonal of the source's box.
constexpr double kMaxMedian = 1.65;
constexpr double kMaxOvershoot = 0.1;

/// Part of the diagonal that CGAL's distance may be off by.
constexpr double kCgalError = 1e-3;

struct Totals
{
    size_t meshes = 0, cuts = 0, failures = 0;
    std::vector<double> ratios;
};

/// Compare the search with CGAL's on the coarsest cut, both ways. False if they disagree.
bool agreesWithCgal(const mesh::SourceMesh& mesh, const clusters::Hierarchy& hierarchy,
                    const clusters::DecodedHierarchy& decoded, const cuts::CutError& coarsest,
                    double diagonal)
{
    const auto triangles = cuts::trianglesOfCut(
        hierarchy, decoded, cuts::cutAtError(hierarchy, double{hierarchy.levels.back().max_error}));
    const TriangleSurface source{mesh.positions, mesh.indices}, cut{decoded.positions, triangles};
    const double error = kCgalError * diagonal;
    const double distance = std::max(cgalDistance(cut, source, error), cgalDistance(source, cut, error));
    const bool agrees =
        distance <= coarsest.distance.upper + error && distance >= coarsest.distance.lower - error;
    std::printf("  CGAL, coarsest cut: %.3f +- %.3f %% of the diagonal, here %.3f: %s\n",
                100 * distance / diagonal, 100 * kCgalError, 100 * coarsest.distance.lower / diagonal,
                agrees ? "agrees" : "DISAGREES");
    return agrees;
}

void measureMesh(const std::string& name, const mesh::SourceMesh& mesh, bool boxes_only, Totals& totals)
{
    const clusters::Hierarchy hierarchy = clusters::buildHierarchy(mesh);
    if (hierarchy.clusters.empty())
        return;
    ++totals.meshes;
    const cuts::Overshoot overshoot = cuts::measureOvershoot(hierarchy);
    const double diagonal = overshoot.diagonal;
    const bool leaves = overshoot.part > kMaxOvershoot;
    totals.failures += leaves ? 1 : 0;
    if (!boxes_only || overshoot.part > kMaxOvershoot / 2)
        std::printf("%s: %zu triangles, %zu levels, %.1f %% of the diagonal beyond the box at level %u%s\n",
                    name.c_str(), mesh.triangleCount(), hierarchy.levels.size(), 100 * overshoot.part,
                    overshoot.level, leaves ? ": TOO FAR" : "");
    const auto decoded = clusters::decodeHierarchy(hierarchy);
    if (boxes_only || !decoded.ok() || hierarchy.levels.size() < 2)
        return;
    const double rounding = 1e-6 * diagonal;
    const auto errors = cuts::certifyLevels(mesh, hierarchy, *decoded, {.absolute = rounding});
    for (const cuts::CutError& cut : errors)
    {
        const bool broken = cut.distance.lower > cut.stored + rounding;
        const double ratio = cut.stored / cut.distance.lower;
        totals.failures += broken ? 1 : 0;
        ++totals.cuts;
        totals.ratios.push_back(ratio);
        std::printf(
            "  level %2u, %7zu triangles: distance %.4f to %.4f %% of the diagonal, stored %.4f: %.2f%s\n",
            cut.level, cut.triangles, 100 * cut.distance.lower / diagonal,
            100 * cut.distance.upper / diagonal, 100 * cut.stored / diagonal, ratio,
            broken ? ": NO BOUND" : "");
    }
    std::fflush(stdout);
    totals.failures += agreesWithCgal(mesh, hierarchy, *decoded, errors.back(), diagonal) ? 0 : 1;
    std::fflush(stdout);
}

double findMedian(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    return values.empty() ? 0 : values[values.size() / 2];
}

/// Measure rocks and terrains of seeds that no test uses.
void measureGenerated(Totals& totals)
{
    for (const uint32_t seed : {9001u, 9002u, 9003u})
    {
        const std::string number = std::to_string(seed);
        measureMesh("rock " + number, shapes::rock(48, 0.4f, seed), false, totals);
        measureMesh("smoother rock " + number, shapes::rock(40, 0.2f, seed), false, totals);
        measureMesh("terrain " + number, shapes::terrain(128, seed), false, totals);
    }
    const double median = findMedian(totals.ratios);
    totals.failures += median > kMaxMedian ? 1 : 0;
    std::printf("generated meshes: stored error / certified distance %.2f in the median (at most %.2f)\n",
                median, kMaxMedian);
}

Status measurePart(const std::string& path, bool boxes_only, Totals& totals)
{
    HEARTH_ASSIGN_OR_RETURN(const formats::ContainerReader reader, formats::ContainerReader::open(path));
    for (uint32_t i = 0; reader.find(formats::kChunkSourceMesh, i) != nullptr; ++i)
    {
        HEARTH_ASSIGN_OR_RETURN(const mesh::SourceMesh mesh, mesh::readSourceMesh(reader, i));
        const std::string file = path.substr(path.find_last_of('/') + 1);
        measureMesh(file + ", mesh " + std::to_string(i) + " " + mesh.name, mesh, boxes_only, totals);
    }
    return success();
}

int program(int argc, char** argv)
{
    cli::CommandLine app("Measures stored errors of clusters against certified distances.");
    std::vector<std::string> parts;
    bool boxes_only = false;
    app.addOption("PART", parts, "import parts; none: generated meshes");
    app.addFlag("--boxes", boxes_only, "only measure how far levels leave the box of their source");
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    Totals totals;
    if (parts.empty())
        measureGenerated(totals);
    for (const std::string& part : parts)
        if (const Status measured = measurePart(part, boxes_only, totals); !measured.ok())
            return reportFailure(measured.error());
    std::printf("%zu meshes, %zu cuts, median %.2f; %zu failures\n", totals.meshes, totals.cuts,
                findMedian(totals.ratios), totals.failures);
    return totals.failures == 0 ? 0 : 1;
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::runProgram("hearth_measure_error", [&] { return program(argc, argv); });
}
