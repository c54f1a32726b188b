// Prints the statistics that hearth-render wrote for the scene of the talk, beside the talk's figures, and
// holds them against the aims of "runtime". `./dev bench runtime` makes the scene, draws it and runs this.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "cook/json/json.h"
#include "formats/base/program.h"
#include "formats/gpu_shared/records.h"
#include "tests/bench/aims.h"
#include "tests/bench/visible_figures.h"
#include "tests/reference/flip.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <limits>

namespace
{

using namespace hearth;

constexpr double kMebi = 1 << 20;

/// A stage of the talk's renderer and the corresponding passes of this one.
struct Stage
{
    const char* name;
    double high_end_ms; ///< the talk's table, Immortalis-G715
    double low_end_ms;  ///< the talk's table, a phone five years older
    const char* passes;
    std::array<const char*, 3> times; ///< names in the statistics; null: none
};

constexpr Stage kStages[] = {
    {"culling, binning",
     0.11 + 0.07 + 0.2,
     1.08 + 1.79 + 3.25,
     "cull, pyramid, late cull",
     {"cull", "pyramid", "late_cull"}},
    {"rasterization", 0.72, 2.67, "visibility, both phases", {"early_visibility", "visibility", nullptr}},
    {"material classify", 0.92, 3.42, "material tiles", {"material_tiles", nullptr, nullptr}},
    {"material shading", 0.87, 7.31, "marks of materials, shading", {"shading", nullptr, nullptr}},
};

struct Arguments
{
    std::string pack, path_stats, cold_stats, resident, converged;
    std::vector<std::string> visibility;
};

Result<Json> readStatistics(const std::string& path)
{
    std::ifstream file(path);
    if (!file)
        return Error{Issue::input_missing, path, "", ""};
    const std::string text(std::istreambuf_iterator<char>(file), {});
    Json statistics = Json::parse(text).value_or(Json());
    if (!statistics.is_object() || statistics.value("schema", "") != "hearth.frame/1")
        return Error{Issue::usage, path, "", "the file is no statistics of hearth-render"};
    return statistics;
}

double number(const Json& object, const char* member)
{
    return object.at(member).get<double>();
}

void printTimes(const Json& statistics)
{
    const auto device = statistics.at("device").get<std::string>();
    std::printf("Milliseconds a frame, medians of the path, on %s\n", device.c_str());
    if (device.find("llvmpipe") != std::string::npos)
        std::printf("THIS IS A CPU: the last column says nothing about a GPU. With one, the same command "
                    "measures.\n");
    std::printf("  %-18s %14s %14s %10s   %s\n", "the talk's stage", "Immortalis-G715", "5 years older",
                "Hearth", "passes");
    const Json& times = statistics.at("milliseconds");
    double high_end = 0, low_end = 0;
    for (const Stage& stage : kStages)
    {
        double ms = 0;
        for (const char* const pass : stage.times)
            ms += pass == nullptr ? 0 : number(times, pass);
        std::printf("  %-18s %14.2f %14.2f %10.2f   %s\n", stage.name, stage.high_end_ms, stage.low_end_ms,
                    ms, stage.passes);
        high_end += stage.high_end_ms;
        low_end += stage.low_end_ms;
    }
    std::printf("  %-18s %14.2f %14.2f %10.2f\n\n", "frame", high_end, low_end, number(times, "frame"));
}

void printVisible(const char* name, const bench::VisibleFigures& figures, double frames)
{
    std::printf("  %-8s %10.0f %10.0f %8.2f %12.0f %12.0f %10.0f %10.2f\n", name,
                static_cast<double>(figures.drawn_clusters) / frames,
                static_cast<double>(figures.owning_clusters) / frames, figures.drawnOverOwning(),
                static_cast<double>(figures.drawn_triangles) / frames,
                static_cast<double>(figures.owning_triangles) / frames,
                static_cast<double>(figures.covered_pixels) / frames, figures.trianglesPerPixel());
}

/// Print means over the frames of the camera path.
Status printCounts(const Arguments& arguments, const formats::PackView& pack, const Json& statistics,
                   bench::Judgement& judgement)
{
    bench::FiguresOfKind kinds;
    for (const std::string& file : arguments.visibility)
    {
        HEARTH_ASSIGN_OR_RETURN(const bench::FiguresOfKind frame, bench::readVisibleFigures(file, pack));
        for (const auto& [kind, figures] : frame)
            kinds[kind].add(figures);
    }
    const auto frames = static_cast<double>(arguments.visibility.size());
    std::printf("Drawn and seen, means of %.0f frames of %.0f x %.0f at %.2f pixels of error\n", frames,
                number(statistics, "width"), number(statistics, "height"),
                number(statistics, "error_pixels"));
    std::printf("  %-8s %10s %10s %8s %12s %12s %10s %10s\n", "", "clusters", "seen", "ratio", "triangles",
                "seen", "pixels", "tri/pixel");
    for (const auto& [kind, figures] : kinds)
        printVisible(kind.c_str(), figures, frames);
    kinds.erase("sky"); // a backdrop: many pixels for almost no triangles
    const bench::VisibleFigures all = bench::sumUp(kinds);
    printVisible("scene", all, frames);
    judgement.record("clusters drawn / seen", all.drawnOverOwning());
    judgement.record("triangles a covered pixel", all.trianglesPerPixel());
    const double slot_bytes =
        static_cast<double>(all.drawn_clusters) / frames * sizeof(shared::VisibleCluster);
    std::printf("  shaded area / image %.2f; visible list %.0f KiB; attachments and pyramid %.1f MiB\n\n",
                number(statistics, "shaded_area_pixels") /
                    (number(statistics, "width") * number(statistics, "height")),
                slot_bytes / 1024, number(statistics, "target_bytes") / kMebi);
    return success();
}

void printBytes(const formats::PackView& pack, const Json& statistics)
{
    double unique = 0;
    for (const formats::MeshRecord& mesh : pack.meshes())
        unique += mesh.source_triangles;
    const double drawn = number(statistics, "source_triangles"), bytes = number(statistics, "scene_bytes");
    std::printf(
        "Everything resident: %.1f MiB with tables and textures, %.1f bytes a triangle of the %.1f M in the "
        "scene,\n  %.1f of the %.1f M in the meshes\n\n",
        bytes / kMebi, bytes / drawn, drawn * 1e-6, bytes / unique, unique * 1e-6);
}

/// First frame, from 1, from which on all frames are converged; infinity if the last one is not.
double findConvergence(const Json& frames)
{
    size_t first = 0;
    for (size_t i = 0; i < frames.size(); ++i)
        if (!frames[i].at("converged").get<bool>())
            first = 0;
        else if (first == 0)
            first = i + 1;
    return first == 0 ? std::numeric_limits<double>::infinity() : static_cast<double>(first);
}

Status printStreaming(const Arguments& arguments, const Json& statistics, bench::Judgement& judgement)
{
    const Json& stream = statistics.at("streaming");
    std::printf("From a cold start within %.0f MiB of geometry, the eye at rest\n",
                number(stream, "budget_bytes") / kMebi);
    const double converged = findConvergence(stream.at("frames"));
    judgement.record("frame of convergence from a cold start", converged);
    std::printf("  converged in frame %.0f of %zu\n", converged, stream.at("frames").size());
    std::printf(
        "  streamed %.1f MiB; resident %.1f MiB in %.0f pages, %.1f MiB of the budget in use; error scale "
        "%.3f\n",
        number(stream, "bytes_streamed") / kMebi, number(stream, "bytes_resident") / kMebi,
        number(stream, "pages_resident"), number(stream, "bytes_in_use") / kMebi,
        number(stream, "error_scale"));
    std::printf("  resident, with tables and textures: %.1f MiB, %.2f bytes a triangle of the scene\n",
                number(statistics, "scene_bytes") / kMebi,
                number(statistics, "scene_bytes") / number(statistics, "source_triangles"));
    HEARTH_ASSIGN_OR_RETURN(const reference::Image resident, reference::readPng(arguments.resident));
    HEARTH_ASSIGN_OR_RETURN(const reference::Image image, reference::readPng(arguments.converged));
    if (image.width != resident.width || image.height != resident.height)
        return Error{Issue::usage, arguments.converged, "", "the image has another size"};
    judgement.record("mean FLIP within the budget", reference::flip(resident, image).mean());
    return success();
}

/// returns  exit code: 1 if an aim is missed
Result<int> measure(const Arguments& arguments)
{
    HEARTH_ASSIGN_OR_RETURN(formats::ContainerReader reader, formats::ContainerReader::open(arguments.pack));
    HEARTH_ASSIGN_OR_RETURN(const formats::PackView pack, formats::PackView::read(std::move(reader)));
    HEARTH_ASSIGN_OR_RETURN(const Json path, readStatistics(arguments.path_stats));
    HEARTH_ASSIGN_OR_RETURN(const Json cold, readStatistics(arguments.cold_stats));
    bench::Judgement judgement("runtime");
    printTimes(path);
    HEARTH_TRY(printCounts(arguments, pack, path, judgement));
    printBytes(pack, path);
    HEARTH_TRY(printStreaming(arguments, cold, judgement));
    return judgement.finish();
}

int program(int argc, char** argv)
{
    cli::CommandLine app("Prints what hearth-render drew of a pack, beside the figures of the talk.");
    Arguments arguments;
    app.addOption("PACK", arguments.pack, "the pack that was drawn").required();
    app.addOption("--path", arguments.path_stats, "statistics along a camera path, everything resident")
        .required();
    app.addOption("--visibility", arguments.visibility, "dumps of the frames of that path that count")
        .required();
    app.addOption("--cold", arguments.cold_stats, "statistics of equal frames within a budget").required();
    app.addOption("--resident", arguments.resident, "the image of these frames, everything resident")
        .required();
    app.addOption("--converged", arguments.converged, "the last image within the budget").required();
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    const Result<int> measured = measure(arguments);
    return measured.ok() ? *measured : reportFailure(measured.error());
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::runProgram("hearth_measure_runtime", [&] { return program(argc, argv); });
}
