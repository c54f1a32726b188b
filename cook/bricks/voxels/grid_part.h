// Cooks the part with the brick grid from the parts of one or more sources. See cook/bricks/README.md.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/grid/grid_settings.h"
#include "cook/bricks/voxels/leaks.h"
#include "cook/bricks/voxels/memory_budget.h"
#include "cook/bricks/voxels/voxelise.h"

#include <string>

namespace hearth::bricks
{

/// Statistics of a cooked grid, for the report.
struct GridStatistics
{
    GridFrame frame;
    double error = 0; ///< metres in world space: LOD error allowed for the clusters
    ExcludedInstances left_out;
    uint64_t instances = 0;
    VoxeliseStatistics counts;
    LeakStatistics leaks;
    uint64_t bricks = 0;
    uint64_t solid_voxels = 0;
    uint64_t opaque_voxels = 0;
    uint64_t faces = 0;
    uint64_t sealed_spaces = 0;
    uint64_t sealed_sides = 0; ///< voxel sides towards sealed spaces; they are no faces
    DroppedBricks dropped;
    BrickBytes bytes;
    double voxelise_seconds = 0;
    double faces_seconds = 0;
    double emission_seconds = 0;
    uint64_t light_sweeps = 0; ///< until the light had settled
    double light_seconds = 0;
};

struct CookedGrid
{
    BrickTables tables;
    GridStatistics statistics;
};

/// Cook the grid. The result does not depend on the number of threads.
/// errors: usage for settings that make no sense; errors of voxelise
Result<CookedGrid> cookGrid(const StaticScene& scene, const GridSettings& settings);

/// Write a part with the grid.
Status writeGridPart(const std::string& path, const CookedGrid& grid);

/// Write a part without a grid: it says why the scene has none.
Status writePartWithoutGrid(const std::string& path, const std::string& reason);

/// Return the statistics of such a part as JSON text, of the same schema.
std::string statisticsWithoutGrid(const std::string& reason);

/// Return the statistics as JSON text: schema "hearth.bricks/1".
std::string statisticsJson(const GridStatistics& statistics);

/// Return a table of the grid's memory beside the figures published for 512 x 512 x 128 m in "Seamless
/// rendering on mobile", SIGGRAPH 2024, Advances in Real-Time Rendering in Games.
std::string memoryText(const GridStatistics& statistics);

} // namespace hearth::bricks
