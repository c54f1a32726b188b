// Which tests left out how much of a frame, for people and tools.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/cull_statistics.h"
#include "formats/gpu_shared/records.h"

#include <string>

namespace hearth::viewer
{

/// Each is counted at the first test that it fails: all of them but `occlusion_early` add up to `tested`.
struct CullCounts
{
    uint64_t tested = 0;   ///< in the scene
    uint64_t instance = 0; ///< clusters and triangles of instances that are not drawn
    uint64_t lod = 0;      ///< not in the cut
    uint64_t frustum = 0;  ///< outside
    uint64_t cone = 0;     ///< facing away
    uint64_t occlusion_early =
        0;                  ///< hidden by the last frame's depth; the late phase draws some of them after all
    uint64_t occlusion = 0; ///< hidden
    uint64_t drawn = 0;
};

struct CullReport
{
    uint64_t empty_instances = 0; ///< of meshes without triangles
    CullCounts instances, clusters, triangles;
};

/// Triangles of clusters for which the visible list had no slot count as occluded.
CullReport makeCullReport(const shared::CullStatistics& statistics, const shared::FrameCounters& counters,
                          uint64_t early_triangles, uint64_t drawn_triangles);

/// A JSON object.
std::string formatCullReport(const CullReport& report);

} // namespace hearth::viewer
