// Measures stored errors of whole meshes against certified distances, and how far levels leave the box of
// their source. Fails where an error is no bound, where a level leaves the box, or where the errors of
// generated meshes are loose. `./dev bench error` runs it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "cook/mesh/source_mesh.h"
#include "formats/base/program.h"
#include "formats/pack/pack_view.h"
#include "tests/bench/aims.h"
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

// Part of the diagonal beyond the box from which meshes that are only measured for it are named.
constexpr double kNamedOvershoot = 0.05;

/// Part by which the upper bound of a certified distance may exceed the lower one.
constexpr double kRelative = 0.005;

/// Part of the diagonal that CGAL's distance may be off by.
constexpr double kCgalError = 1e-3;

struct Totals
{
    size_t meshes = 0, broken_cuts = 0, cgal_differences = 0;
    double overshoot = 0;
    std::vector<double> ratios; ///< stored error / certified distance, of all cuts
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
    totals.overshoot = std::max(totals.overshoot, overshoot.part);
    if (!boxes_only || overshoot.part > kNamedOvershoot)
        std::printf("%s: %zu triangles, %zu levels, %.1f %% of the diagonal beyond the box at level %u\n",
                    name.c_str(), mesh.triangleCount(), hierarchy.levels.size(), 100 * overshoot.part,
                    overshoot.level);
    const auto decoded = clusters::decodeHierarchy(hierarchy);
    if (boxes_only || !decoded.ok() || hierarchy.levels.size() < 2)
        return;
    const double rounding = 1e-6 * diagonal;
    const auto errors =
        cuts::certifyLevels(mesh, hierarchy, *decoded, {.relative = kRelative, .absolute = rounding});
    for (const cuts::CutError& cut : errors)
    {
        const bool broken = cut.distance.lower > cut.stored + rounding;
        const double ratio = cut.stored / cut.distance.lower;
        totals.broken_cuts += broken ? 1 : 0;
        totals.ratios.push_back(ratio);
        std::printf(
            "  level %2u, %7zu triangles: distance %.4f to %.4f %% of the diagonal, stored %.4f: %.2f%s\n",
            cut.level, cut.triangles, 100 * cut.distance.lower / diagonal,
            100 * cut.distance.upper / diagonal, 100 * cut.stored / diagonal, ratio,
            broken ? ": NO BOUND" : "");
    }
    std::fflush(stdout);
    totals.cgal_differences += agreesWithCgal(mesh, hierarchy, *decoded, errors.back(), diagonal) ? 0 : 1;
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

/// returns  exit code: 1 if an aim is missed
int judge(const Totals& totals, bool is_generated, bool boxes_only)
{
    constexpr const char* kBroken = "cuts beyond their stored error";
    constexpr const char* kCgal = "cuts whose distance is not CGAL's";
    constexpr const char* kMedian = "median stored error / distance, generated";
    bench::Judgement judgement("error");
    judgement.record("box left, part of its diagonal", totals.overshoot);
    if (boxes_only)
    {
        judgement.leaveOut(kBroken);
        judgement.leaveOut(kCgal);
    }
    else
    {
        judgement.record(kBroken, static_cast<double>(totals.broken_cuts));
        judgement.record(kCgal, static_cast<double>(totals.cgal_differences));
    }
    if (is_generated && !boxes_only)
        judgement.record(kMedian, findMedian(totals.ratios));
    else
        judgement.leaveOut(kMedian);
    return judgement.finish();
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
    std::printf("%zu meshes, %zu cuts, median %.2f\n", totals.meshes, totals.ratios.size(),
                findMedian(totals.ratios));
    return judge(totals, parts.empty(), boxes_only);
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::runProgram("hearth_measure_error", [&] { return program(argc, argv); });
}
