// hearth_measure_bricks: voxelises a landscape from coarse clusters and from its finest triangles. Prints
// seconds, differences, the memory beside the talk's figures, and the finest voxels that fit into the talk's
// memory, and holds them against the aims of "bricks".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/voxels/grid_part.h"
#include "cook/command_line/command_line.h"
#include "cook/tools/open_part.h"
#include "formats/base/program.h"
#include "tests/bench/aims.h"

#include <cstdio>
#include <ctime>
#include <limits>

#include <tbb/global_control.h>

namespace
{

using namespace hearth;
using namespace hearth::bricks;

// Memory of all of the talk's tables.
constexpr uint64_t kTalksBytes = uint64_t{28} << 20;
constexpr uint64_t kAnyMemory = std::numeric_limits<uint64_t>::max();

GridSettings makeSettings(double voxel_size, double error_share, uint64_t memory)
{
    GridSettings settings;
    settings.voxel_size = voxel_size;
    settings.min = {-256, -64, -256};
    settings.max = {256, 64, 256};
    settings.memory = memory;
    settings.error_share = error_share;
    return settings;
}

/// A grid and the CPU seconds that it took. Wall-clock time would include other load of the machine.
struct Timed
{
    CookedGrid grid;
    double cpu_seconds;
    double seconds() const { return grid.statistics.voxelise_seconds + grid.statistics.faces_seconds; }
};

Result<Timed> timed(const StaticScene& scene, const GridSettings& settings)
{
    const std::clock_t start = std::clock();
    HEARTH_ASSIGN_OR_RETURN(CookedGrid grid, cookGrid(scene, settings));
    return Timed{std::move(grid), static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC};
}

/// Count the solid voxels that the other grid lacks; both have the same groups.
uint64_t voxelsMissing(const BrickTables& from, const BrickTables& other)
{
    const auto makeMask = [](uint32_t low, uint32_t high) { return uint64_t{high} << 32 | low; };
    uint64_t missing = 0;
    for (size_t g = 0; g < from.groups.size(); ++g)
        for (uint32_t bit = 0; bit < 64; ++bit)
        {
            const auto voxelsAt = [&](const BrickTables& tables)
            {
                const formats::BrickGroupRecord& group = tables.groups[g];
                if (!shared::maskHas(group.brick_mask_low, group.brick_mask_high, bit))
                    return uint64_t{0};
                const formats::BrickRecord& brick =
                    tables.bricks[group.first_brick +
                                  shared::maskCountBelow(group.brick_mask_low, group.brick_mask_high, bit)];
                return makeMask(brick.voxel_mask_low, brick.voxel_mask_high);
            };
            missing += static_cast<uint64_t>(std::popcount(voxelsAt(from) & ~voxelsAt(other)));
        }
    return missing;
}

/// returns  exit code: 1 if an aim is missed
Result<int> measure(const std::vector<std::string>& paths)
{
    std::vector<SourceParts> sources;
    HEARTH_ASSIGN_OR_RETURN(formats::PackView scene_part, tools::openPart(paths[0]));
    HEARTH_ASSIGN_OR_RETURN(formats::PackView clusters, tools::openPart(paths[1]));
    HEARTH_ASSIGN_OR_RETURN(formats::PackView textures, tools::openPart(paths[2]));
    sources.push_back({std::move(scene_part), std::move(clusters), std::move(textures)});
    HEARTH_ASSIGN_OR_RETURN(const StaticScene scene, collectStaticScene(sources));
    std::printf("512 x 512 x 128 m, %zu instances, voxels of 1 m, %zu threads\n\n", scene.instances.size(),
                tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));

    HEARTH_ASSIGN_OR_RETURN(const Timed finest, timed(scene, makeSettings(1, 0, kAnyMemory)));
    std::printf("%-22s%12s%12s%10s%10s%8s%16s\n", "clusters off by", "triangles", "pieces", "seconds",
                "CPU s", "ratio", "voxels differ");
    std::string memory;
    bench::Judgement judgement("bricks");
    for (const double share : {0.5, 0.25, 0.125, 0.0})
    {
        HEARTH_ASSIGN_OR_RETURN(const Timed cooked, timed(scene, makeSettings(1, share, kAnyMemory)));
        const CookedGrid& grid = cooked.grid;
        const uint64_t differ =
            voxelsMissing(grid.tables, finest.grid.tables) + voxelsMissing(finest.grid.tables, grid.tables);
        char name[32];
        std::snprintf(name, sizeof(name), share > 0 ? "%.3g voxels" : "nothing: the finest", share);
        std::printf("%-22s%12llu%12llu%10.2f%10.2f%8.2f%14.2f %%\n", name,
                    static_cast<unsigned long long>(grid.statistics.counts.triangles),
                    static_cast<unsigned long long>(grid.statistics.counts.pieces), cooked.seconds(),
                    cooked.cpu_seconds, finest.cpu_seconds / cooked.cpu_seconds,
                    100 * static_cast<double>(differ) /
                        static_cast<double>(finest.grid.statistics.solid_voxels));
        if (share == GridSettings().error_share)
        {
            memory = memoryText(grid.statistics);
            judgement.record("seconds for voxels of 1 m", cooked.seconds());
        }
    }
    std::printf("\n%s\n", memory.c_str());

    double fits = std::numeric_limits<double>::infinity();
    for (const double size : {1.0, 0.8, 0.64, 0.5, 0.4})
    {
        HEARTH_ASSIGN_OR_RETURN(const Timed cooked,
                                timed(scene, makeSettings(size, GridSettings().error_share, kTalksBytes)));
        const GridStatistics& statistics = cooked.grid.statistics;
        if (statistics.dropped.any())
            break;
        fits = size;
        std::printf("voxels of %.2f m: %.1f MiB, %llu faces, %.2f s, %.2f CPU s\n", size,
                    static_cast<double>(statistics.bytes.total()) / (1 << 20),
                    static_cast<unsigned long long>(statistics.faces), cooked.seconds(), cooked.cpu_seconds);
    }
    judgement.record("finest voxels within 28 MiB, m", fits);
    return judgement.finish();
}

int program(int argc, char** argv)
{
    cli::CommandLine app("Measures how a land becomes bricks.", "hearth_measure_bricks");
    std::vector<std::string> parts;
    app.addOption("PARTS", parts, "import, clusters and textures part of hearth-samples land")
        .required()
        .expected(3);
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    const Result<int> done = measure(parts);
    return done.ok() ? *done : reportFailure(done.error());
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::runProgram("hearth_measure_bricks", [&] { return program(argc, argv); });
}
