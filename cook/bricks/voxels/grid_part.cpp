// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/voxels/grid_part.h"
#include "cook/bricks/voxels/blend_sides.h"

#include "cook/bricks/voxels/opacity.h"
#include "cook/json/json.h"

#include <chrono>
#include <cmath>

namespace hearth::bricks
{

using namespace formats;

namespace
{

double secondsSince(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Voxels along an edge of those of a probe, by which the first size is chosen. A probe takes a sixteenth of
// the time that the grid takes.
constexpr double kProbedVoxels = 4;

// Predicted bytes over those that fit, up to which a size is tried.
constexpr double kDoubt = 1.1;

// Pieces into which voxels cut triangles. Grids that fill their memory have two million; where triangles lie
// upon each other in thousands, the voxels are larger.
constexpr double kMaxPieces = 4e6;

constexpr const char* kStatisticsSchema = "hearth.bricks/1";

/// Return the focus points: cameras and seeds; without any, the middle of the static instances.
std::vector<Float3> findFocusPoints(const StaticScene& scene, const GridSettings& settings)
{
    std::vector<Float3> foci = scene.cameras;
    foci.insert(foci.end(), settings.seeds.begin(), settings.seeds.end());
    if (!foci.empty())
        return foci;
    Double3 sum;
    for (const StaticInstance& instance : scene.instances)
        sum = sum + widen(instance.box.center());
    const double count = std::max<double>(1, static_cast<double>(scene.instances.size()));
    return {narrow(sum * (1 / count))};
}

CookedGrid cooked(const StaticScene& scene, const VoxeliseResult& voxelised, const GridWithFaces& faced)
{
    CookedGrid cooked{makeBrickTables(faced.solid, faced.faces), {}};
    GridStatistics& statistics = cooked.statistics;
    statistics.frame = faced.solid.frame;
    statistics.left_out = scene.left_out;
    statistics.instances = scene.instances.size();
    statistics.counts = voxelised.counts;
    statistics.bricks = cooked.tables.bricks.size();
    statistics.solid_voxels = cooked.tables.opacity.size();
    for (const uint8_t opacity : cooked.tables.opacity)
        statistics.opaque_voxels += opacity == kOpaque ? 1 : 0;
    statistics.faces = cooked.tables.albedo.size();
    statistics.sealed_spaces = faced.seen.sealed;
    statistics.sealed_sides = faced.seen.sealed_sides;
    statistics.dropped = faced.dropped;
    statistics.bytes = faced.bytes();
    return cooked;
}

/// Cook at one voxel size. Return nothing if keep_all is set and bricks would have to be dropped.
Result<std::optional<CookedGrid>> cookAt(const StaticScene& scene, const GridSettings& settings, double size,
                                         bool keep_all)
{
    HEARTH_ASSIGN_OR_RETURN(const GridFrame frame, makeGridFrame(settings, scene.box(), size));
    const double error = size * settings.error_share;
    auto start = std::chrono::steady_clock::now();
    const std::vector<Float3> foci = findFocusPoints(scene, settings);
    HEARTH_ASSIGN_OR_RETURN(
        VoxeliseResult voxelised,
        voxelise(scene, findCutClusters(scene, static_cast<float>(error)), frame, foci, settings.memory));
    computeOpacities(voxelised.grid);
    blendSides(voxelised.grid);
    const std::vector<ClosedProxy> proxies = findClosedProxies(scene);
    const LeakStatistics leaks =
        closeLeaks(voxelised.grid, proxies.size(),
                   [&](size_t i) { return makeClosedSurface(scene, proxies[i], frame); });
    const double voxelise_seconds = secondsSince(start);

    start = std::chrono::steady_clock::now();
    std::vector<Float3> seen_points = scene.cameras;
    seen_points.insert(seen_points.end(), settings.seeds.begin(), settings.seeds.end());
    GridWithFaces faced = fitToMemory(std::move(voxelised.grid), seen_points, foci, settings.memory);
    faced.dropped.tiles = voxelised.tiles_skipped;
    if (keep_all && faced.dropped.any())
        return std::optional<CookedGrid>();
    CookedGrid grid = cooked(scene, voxelised, faced);
    grid.statistics.error = error;
    grid.statistics.leaks = leaks;
    grid.statistics.voxelise_seconds = voxelise_seconds;
    grid.statistics.faces_seconds = secondsSince(start);
    return std::optional(std::move(grid));
}

/// Bytes and pieces that a grid takes, predicted from one of larger voxels.
class SizePrediction
{
public:
    explicit SizePrediction(const GridStatistics& probed) : probed_(probed) {}

    /// Predict that a grid is too large, with some doubt about its bytes.
    bool isTooLarge(double size, uint64_t memory) const
    {
        const double voxels = std::pow(probed_.frame.voxel_size / size, 2); // surfaces take, for each before
        const auto bytes = static_cast<double>(probed_.bytes.total());
        const auto triangles = static_cast<double>(probed_.counts.triangles);
        const double cuts = static_cast<double>(probed_.counts.pieces) - triangles;
        return bytes * voxels > kDoubt * static_cast<double>(memory) ||
               triangles + cuts * voxels > kMaxPieces;
    }

private:
    const GridStatistics& probed_;
};

/// Return the size of the first voxels to try: the finest ones whose grid may fit.
Result<double> chooseFirstSize(const StaticScene& scene, const GridSettings& settings, double finest)
{
    HEARTH_TRY(makeGridFrame(settings, scene.box(), finest)); // refuses a memory that holds no grid of it
    const double probe = finest * kProbedVoxels;
    HEARTH_ASSIGN_OR_RETURN(const std::optional<CookedGrid> probed, cookAt(scene, settings, probe, true));
    if (!probed)
        return nextVoxelSize(probe);
    const SizePrediction prediction(probed->statistics);
    double size = finest;
    while (size < probe && prediction.isTooLarge(size, settings.memory))
        size = nextVoxelSize(size);
    return size;
}

/// Row of the memory table: a table of the grid beside the table of the SIGGRAPH talk, with the talk's sizes.
struct Row
{
    const char* talks;
    double talks_kib;
    const char* ours;
    uint64_t bytes;
};

std::array<Row, 10> memoryRows(const BrickBytes& bytes)
{
    return {Row{"BrickGroupBitMask", 64, "groups", bytes.groups},
            Row{"BrickTexture", 2048, "in groups", 0},
            Row{"BrickBitMask", 16, "bricks", bytes.bricks},
            Row{"BrickOpacityAtlas", 2048, "opacity", bytes.opacity},
            Row{"BrickMappingAtlas", 8192, "in bricks", 0},
            Row{"BrickVisFacesAlbedoAtlas", 4096, "albedo", bytes.albedo},
            Row{"BrickVisFacesNormalAtlas", 4096, "normals", bytes.normals},
            Row{"BrickVisFacesLightingAtlas", 4096, "lighting", bytes.lighting},
            Row{"BrickVisFacesEmissiveAtlas", 4096, "emission", bytes.emission},
            Row{"Total", 28 * 1024, "total", bytes.total()}};
}

Json settingsJson(const GridStatistics& statistics)
{
    const GridFrame& frame = statistics.frame;
    return {{"voxel_size", frame.voxel_size},
            {"origin", {frame.origin.x, frame.origin.y, frame.origin.z}},
            {"dims", frame.voxels},
            {"error", statistics.error}};
}

/// Begin a part whose META has these settings of the grid.
Result<ContainerWriter> beginPart(const std::string& path, const Json& settings)
{
    HEARTH_ASSIGN_OR_RETURN(ContainerWriter writer, ContainerWriter::create(path, ContainerKind::part));
    const Json meta{{"schema", "hearth.meta/1"},
                    {"tool", {{"name", "hearth-bricks"}, {"version", HEARTH_VERSION}}},
                    {"settings", {{"bricks", settings}}}};
    HEARTH_TRY(writer.addText(kChunkMeta, meta.dump(1, '\t')));
    return writer;
}

} // namespace

Result<CookedGrid> cookGrid(const StaticScene& scene, const GridSettings& settings)
{
    double size = settings.voxel_size.value_or(0);
    if (!settings.voxel_size)
    {
        Box3 box = scene.box();
        if (settings.min && settings.max)
            box = {narrow(*settings.min), narrow(*settings.max)};
        HEARTH_ASSIGN_OR_RETURN(size, chooseFirstSize(scene, settings, firstVoxelSize(box)));
    }
    for (;; size = nextVoxelSize(size))
    {
        HEARTH_ASSIGN_OR_RETURN(std::optional<CookedGrid> grid,
                                cookAt(scene, settings, size, !settings.voxel_size));
        if (grid)
            return std::move(*grid);
    }
}

Status writeGridPart(const std::string& path, const CookedGrid& grid)
{
    HEARTH_ASSIGN_OR_RETURN(ContainerWriter writer, beginPart(path, settingsJson(grid.statistics)));
    HEARTH_TRY(writeTables(writer, grid.tables));
    return writer.finish();
}

Status writePartWithoutGrid(const std::string& path, const std::string& reason)
{
    HEARTH_ASSIGN_OR_RETURN(ContainerWriter writer, beginPart(path, {{"none", reason}}));
    return writer.finish();
}

std::string statisticsWithoutGrid(const std::string& reason)
{
    return Json{{"schema", kStatisticsSchema}, {"none", reason}}.dump(1) + "\n";
}

std::string statisticsJson(const GridStatistics& statistics)
{
    Json json{{"schema", kStatisticsSchema}};
    json.update(settingsJson(statistics));
    json["instances"] = statistics.instances;
    json["left_out"] = {{"animated", statistics.left_out.animated},
                        {"deformed", statistics.left_out.deformed},
                        {"unlit", statistics.left_out.unlit}};
    json["clusters"] = statistics.counts.clusters;
    json["triangles"] = statistics.counts.triangles;
    json["pieces"] = statistics.counts.pieces;
    json["leaks"] = {{"surfaces", statistics.leaks.surfaces},
                     {"loose_surfaces", statistics.leaks.loose_surfaces},
                     {"voxels", statistics.leaks.voxels}};
    json["bricks"] = statistics.bricks;
    json["solid_voxels"] = statistics.solid_voxels;
    json["opaque_voxels"] = statistics.opaque_voxels;
    json["faces"] = statistics.faces;
    json["sealed"] = {{"spaces", statistics.sealed_spaces}, {"sides", statistics.sealed_sides}};
    json["dropped"] = {{"bricks", statistics.dropped.bricks},
                       {"voxels", statistics.dropped.voxels},
                       {"tiles", statistics.dropped.tiles},
                       {"from_distance", statistics.dropped.from_distance}};
    json["memory"] = Json::array();
    for (const Row& row : memoryRows(statistics.bytes))
        json["memory"].push_back(
            {{"table", row.ours}, {"bytes", row.bytes}, {"talks", row.talks}, {"talks_kib", row.talks_kib}});
    json["light_sweeps"] = statistics.light_sweeps;
    json["seconds"] = {{"voxelise", statistics.voxelise_seconds},
                       {"faces", statistics.faces_seconds},
                       {"emission", statistics.emission_seconds},
                       {"light", statistics.light_seconds}};
    return json.dump(1) + "\n";
}

std::string memoryText(const GridStatistics& statistics)
{
    char line[128];
    std::snprintf(line, sizeof(line), "%-28s%10s   %-10s%12s\n", "the talk's", "KiB", "here", "KiB");
    std::string text = line;
    for (const Row& row : memoryRows(statistics.bytes))
    {
        std::snprintf(line, sizeof(line), "%-28s%10.0f   %-10s%12.1f\n", row.talks, row.talks_kib, row.ours,
                      static_cast<double>(row.bytes) / 1024);
        text += line;
    }
    return text;
}

} // namespace hearth::bricks
