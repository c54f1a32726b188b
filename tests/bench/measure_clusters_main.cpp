// Measures the hierarchies of whole meshes: speed, shape, bytes, quality and truth of the stored errors,
// beside the peers' figures. `./dev bench clusters` makes the meshes and runs it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/levels/authored_lods.h"
#include "cook/clusters/levels/levels.h"
#include "cook/clusters/program/discrete_lods.h"
#include "cook/command_line/command_line.h"
#include "formats/base/program.h"
#include "formats/pack/pack_view.h"
#include "tests/bench/aims.h"
#include "tests/bench/cut_quality.h"
#include "tests/bench/error_plot.h"
#include "tests/bench/page_figures.h"
#include "tests/bench/peer_figures.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <limits>
#include <optional>

#include <sys/resource.h>

#include <tbb/global_control.h>

namespace
{

using namespace hearth;

// Cuts from the finest to the coarsest, dense enough to interpolate between them.
constexpr double kShares[] = {0.9, 0.7, 0.5, 0.4, 0.3, 0.2, 0.1, 0.07, 0.05, 0.03, 0.01, 0.007, 0.005};

struct Times
{
    double user = 0;
    double wall = 0;
};

double userSeconds()
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_utime.tv_sec) + static_cast<double>(usage.ru_utime.tv_usec) * 1e-6;
}

/// Minimum of three runs, as for the peers' figures.
Times measureTimes(const std::function<void()>& work)
{
    Times least{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    for (int run = 0; run < 3; ++run)
    {
        const double user = userSeconds();
        const auto begin = std::chrono::steady_clock::now();
        work();
        least.user = std::min(least.user, userSeconds() - user);
        least.wall = std::min(
            least.wall, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    }
    return least;
}

/// Seconds of Debian's meshoptimizer on the same mesh (clusters once, one halving), to compare machines.
double calibrationSeconds(const mesh::SourceMesh& mesh)
{
    constexpr size_t kVertices = 255, kTriangles = 128;
    return measureTimes(
               [&]
               {
                   const size_t bound =
                       meshopt_buildMeshletsBound(mesh.indices.size(), kVertices, kTriangles);
                   std::vector<meshopt_Meshlet> meshlets(bound);
                   std::vector<unsigned int> vertices(bound * kVertices);
                   std::vector<unsigned char> triangles(bound * kTriangles * 3);
                   meshopt_buildMeshlets(meshlets.data(), vertices.data(), triangles.data(),
                                         mesh.indices.data(), mesh.indices.size(), &mesh.positions[0].x,
                                         mesh.vertexCount(), sizeof(Float3), kVertices, kTriangles, 0);
                   std::vector<unsigned int> half(mesh.indices.size());
                   meshopt_simplify(half.data(), mesh.indices.data(), mesh.indices.size(),
                                    &mesh.positions[0].x, mesh.vertexCount(), sizeof(Float3),
                                    mesh.indices.size() / 2, 1e30f, 0, nullptr);
               })
        .user;
}

size_t trianglesAt(const clusters::Hierarchy& hierarchy, double error)
{
    size_t triangles = 0;
    for (const auto& cluster : hierarchy.clusters)
        if (formats::clusterError(cluster, hierarchy.groups) <= error &&
            hierarchy.groups[cluster.group].error > error)
            triangles += cluster.triangle_count;
    return triangles;
}

/// Least error whose cut has at most this number of triangles.
double errorFor(const clusters::Hierarchy& hierarchy, std::span<const float> errors, size_t triangles)
{
    return *std::partition_point(errors.begin(), errors.end() - 1,
                                 [&](float e) { return trianglesAt(hierarchy, double{e}) > triangles; });
}

std::vector<bench::CutQuality> measureCuts(const mesh::SourceMesh& mesh, const clusters::Hierarchy& hierarchy,
                                           size_t samples)
{
    const auto decoded = clusters::decodeHierarchy(hierarchy);
    HEARTH_ASSERT(decoded.ok());
    std::vector<float> errors{0};
    for (const auto& group : hierarchy.groups)
        if (std::isfinite(group.error))
            errors.push_back(group.error);
    std::sort(errors.begin(), errors.end());
    const bench::CutSurface source = bench::surfaceOfMesh(mesh);
    const bench::CutMeter meter(source, samples);
    std::vector<bench::CutQuality> cuts;
    for (const double share : kShares)
    {
        const auto triangles = static_cast<size_t>(share * static_cast<double>(source.triangleCount()));
        const auto cut = bench::surfaceOfCut(hierarchy, *decoded, errorFor(hierarchy, errors, triangles));
        if (cut.triangleCount() < source.triangleCount() &&
            (cuts.empty() || cut.triangleCount() < cuts.back().triangles))
            cuts.push_back(meter.measure(cut));
    }
    return cuts;
}

/// Triangle count at which a figure that grows from cut to cut reaches a value, by power-law interpolation
/// between the cuts.
std::optional<double> trianglesFor(std::span<const bench::CutQuality> cuts, double bench::CutQuality::*figure,
                                   double value)
{
    for (size_t i = 1; i < cuts.size(); ++i)
    {
        const double fine = cuts[i - 1].*figure, coarse = cuts[i].*figure;
        if (!(fine <= value && value <= coarse) || !(fine > 0) || !(coarse > fine))
            continue;
        const double t = std::log(value / fine) / std::log(coarse / fine);
        return std::exp(std::log(static_cast<double>(cuts[i - 1].triangles)) * (1 - t) +
                        std::log(static_cast<double>(cuts[i].triangles)) * t);
    }
    return std::nullopt;
}

/// Triangles divided by the peer's for the same figure, if the cuts reach it.
std::optional<double> ratioToPeer(std::span<const bench::CutQuality> cuts, double bench::CutQuality::*figure,
                                  double value, double of_peer)
{
    const auto triangles = trianglesFor(cuts, figure, value);
    return triangles ? std::optional(*triangles / of_peer) : std::nullopt;
}

struct PeerRatios
{
    std::optional<double> rms, normals;
};

PeerRatios ratiosToPeer(const bench::MeshCurve& curve, const bench::PeerCut& cut)
{
    const double of_peer = cut.share * curve.source_triangles;
    return {ratioToPeer(curve.cuts, &bench::CutQuality::rms, cut.rms * curve.diagonal, of_peer),
            ratioToPeer(curve.cuts, &bench::CutQuality::normal_rms_deg, cut.normal_rms_deg, of_peer)};
}

void printRatio(const char* what, std::optional<double> ratio)
{
    if (ratio)
        std::printf("  %s %.2f", what, *ratio);
    else
        std::printf("  %s beyond the cuts", what);
}

/// Print medians over all meshes whose cuts reach the peer's figures.
void printMedians(std::span<const bench::MeshCurve> curves)
{
    for (size_t k = 0; k < bench::PeerFigures{}.cuts.size(); ++k)
    {
        std::vector<double> rms, normals;
        double share = 0;
        for (const bench::MeshCurve& curve : curves)
        {
            if (curve.peer == nullptr || curve.peer->cuts[k].share == 0)
                continue;
            share = curve.peer->cuts[k].share;
            const PeerRatios ratios = ratiosToPeer(curve, curve.peer->cuts[k]);
            if (ratios.rms)
                rms.push_back(*ratios.rms);
            if (ratios.normals)
                normals.push_back(*ratios.normals);
        }
        const auto printMedian = [](const char* what, std::vector<double>& ratios)
        {
            if (ratios.empty())
                return;
            std::sort(ratios.begin(), ratios.end());
            std::printf("  %s %.2f, at most %.2f (%zu meshes)", what,
                        (ratios[(ratios.size() - 1) / 2] + ratios[ratios.size() / 2]) / 2, ratios.back(),
                        ratios.size());
        };
        if (rms.empty() && normals.empty())
            continue;
        std::printf("triangles / clod's at %.0f %%, median:", share * 100);
        printMedian("equal rms", rms);
        printMedian("equal normals", normals);
        std::printf("\n");
    }
}

void printQuality(const bench::MeshCurve& curve, bench::Judgement& judgement)
{
    const std::span<const bench::CutQuality> cuts = curve.cuts;
    const double diagonal = curve.diagonal;
    std::printf("  %9s %7s %10s %10s %12s %18s %20s\n", "triangles", "share", "rms 1e-4", "max 1e-4",
                "max / stored", "normal, stored", "UV 1e-4, stored");
    std::vector<double> tightness;
    size_t broken = 0;
    for (const auto& cut : cuts)
    {
        tightness.push_back(cut.max / cut.stored_error);
        broken += cut.max > cut.stored_error + 1e-6 * diagonal ? 1 : 0;
        std::printf("  %9zu %6.1f%% %10.3f %10.2f %12.2f %8.3f%s %8.3f%s %9.3f %10.3f\n", cut.triangles,
                    100.0 * static_cast<double>(cut.triangles) / curve.source_triangles,
                    cut.rms / diagonal * 1e4, cut.max / diagonal * 1e4, tightness.back(), cut.normal_rms_deg,
                    "\u00b0", cut.stored_normal_rms_deg, "\u00b0", cut.uv_rms / diagonal * 1e4,
                    cut.stored_uv_rms / diagonal * 1e4);
    }
    if (tightness.empty())
        return;
    judgement.record("cuts beyond their stored error", static_cast<double>(broken));
    std::sort(tightness.begin(), tightness.end());
    std::printf("  honesty: %zu of %zu cuts beyond their error; stored / measured %.2f in the median\n",
                broken, cuts.size(), 1 / tightness[tightness.size() / 2]);
    if (curve.peer == nullptr)
        return;
    for (const bench::PeerCut& cut : curve.peer->cuts)
    {
        if (cut.share == 0)
            continue;
        const PeerRatios ratios = ratiosToPeer(curve, cut);
        std::printf("  triangles / clod's at %.0f %%:", cut.share * 100);
        printRatio("equal rms", ratios.rms);
        printRatio("equal normals", ratios.normals);
        std::printf("\n");
        if (ratios.rms)
            judgement.record("triangles / clod's for equal rms", *ratios.rms);
        if (ratios.normals)
            judgement.record("triangles / clod's for equal normals", *ratios.normals);
    }
}

void printShape(const clusters::Hierarchy& hierarchy)
{
    double all = 0;
    for (const auto& level : hierarchy.levels)
        all += level.triangle_count;
    const auto source = static_cast<double>(hierarchy.levels.front().triangle_count);
    const auto records = static_cast<double>(clusters::storedBytes(hierarchy) - hierarchy.page_bytes.size());
    const auto& root = hierarchy.levels.back();
    std::printf("  %zu levels, fill %.1f %%, triangles over all levels / source %.3f, coarsest level %u "
                "clusters of %u "
                "triangles, %llu stuck groups\n",
                hierarchy.levels.size(), 100 * all / (128.0 * static_cast<double>(hierarchy.clusters.size())),
                all / source, root.clusters.count, root.triangle_count,
                static_cast<unsigned long long>(hierarchy.counts.stuck_groups));
    const bench::PageFigures pages = bench::measurePages(hierarchy);
    std::printf("  %.2f bytes a source triangle: tables %.2f",
                (static_cast<double>(hierarchy.page_bytes.size()) + records) / source, records / source);
    for (const auto& kind : pages.kinds)
        std::printf(", %s %.2f", kind.name.c_str(), kind.bytes / source);
    std::printf("; decoded %.1f\n", pages.decoded_bytes / source);
    std::printf("  pages decode at %.2f GB/s of what comes out; the zstd in it alone at %.2f\n",
                pages.decoded_bytes / pages.seconds * 1e-9, pages.decoded_bytes / pages.zstd_seconds * 1e-9);
}

/// Build the clusters of all levels with their groups and errors, without pages and records: the same work as
/// the peers', which have neither.
void buildLevelsAlone(const mesh::SourceMesh& mesh)
{
    clusters::JoinedMesh joined = clusters::joinAuthored(mesh, {});
    const clusters::Config config;
    clusters::Build build{std::move(joined.mesh), config, {}, joined.levels, {}};
    clusters::buildLevels(build);
}

bench::MeshCurve measureMesh(const std::string& name, const mesh::SourceMesh& mesh, size_t samples,
                             bench::Judgement& judgement)
{
    const auto* peer = std::find_if(bench::kPeerFigures.begin(), bench::kPeerFigures.end(),
                                    [&](const auto& p) { return p.mesh == name; });
    if (peer == bench::kPeerFigures.end())
        peer = nullptr;
    clusters::Hierarchy hierarchy;
    const auto build = [&] { hierarchy = clusters::buildHierarchy(mesh); };
    Times one, levels, two;
    {
        const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 1);
        one = measureTimes(build);
        levels = measureTimes([&] { buildLevelsAlone(mesh); });
    }
    {
        const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 2);
        two = measureTimes(build);
    }
    const double calibration = calibrationSeconds(mesh);
    const double ktris = static_cast<double>(mesh.triangleCount()) / 1000;
    std::printf("%s: %zu triangles\n", name.c_str(), mesh.triangleCount());
    std::printf("  %.0f k triangles a user second on one thread, %.0f without pages", ktris / one.user,
                ktris / levels.user);
    if (peer != nullptr && peer->ktris_per_second > 0)
        std::printf(" (clod %.0f on its machine)", peer->ktris_per_second);
    std::printf("; time / that of meshlets and one halving by meshoptimizer 0.18: %.2f, %.2f without pages",
                one.user / calibration, levels.user / calibration);
    if (peer != nullptr && peer->calibration > 0)
        std::printf(" (clod %.2f)", peer->calibration);
    std::printf("; two threads %.2f times as fast\n", one.wall / two.wall);
    if (hierarchy.clusters.empty())
        return {};
    printShape(hierarchy);
    if (samples == 0)
        return {};
    const double diagonal = double{length(hierarchy.mesh.box_max - hierarchy.mesh.box_min)};
    bench::MeshCurve curve{name, static_cast<double>(mesh.triangleCount()), diagonal,
                           measureCuts(mesh, hierarchy, samples), peer};
    printQuality(curve, judgement);
    std::fflush(stdout);
    return curve;
}

int program(int argc, char** argv)
{
    cli::CommandLine app("Measures the cluster hierarchies of the meshes of import parts.");
    std::vector<std::string> parts;
    size_t samples = 200000;
    app.addOption("PART", parts, "import parts; their file names name the meshes").required();
    app.addOption("--samples", samples,
                  "points on each of two surfaces that are compared; 0: quality is not measured");
    std::string plot;
    app.addOption("--plot", plot, "write the error of all cuts as an SVG image");
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    std::vector<bench::MeshCurve> curves;
    bench::Judgement judgement("clusters");
    for (const std::string& path : parts)
    {
        const auto reader = formats::ContainerReader::open(path);
        const auto mesh =
            reader.ok() ? mesh::readSourceMesh(*reader, 0) : Result<mesh::SourceMesh>(reader.error());
        if (!mesh.ok())
        {
            return reportFailure(mesh.error());
        }
        const std::string file = path.substr(path.find_last_of('/') + 1);
        curves.push_back(measureMesh(file.substr(0, file.find('.')), *mesh, samples, judgement));
    }
    printMedians(curves);
    if (!plot.empty())
        std::ofstream(plot) << bench::errorPlot(curves);
    if (samples == 0)
        judgement.leaveOut("cuts beyond their stored error");
    if (std::none_of(curves.begin(), curves.end(), [](const auto& curve) { return curve.peer != nullptr; }))
    {
        judgement.leaveOut("triangles / clod's for equal rms");
        judgement.leaveOut("triangles / clod's for equal normals");
    }
    return judgement.finish();
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::runProgram("hearth_measure_clusters", [&] { return program(argc, argv); });
}
