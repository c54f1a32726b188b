// Culling report: how much of a frame each test culled, for people and tools.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/cull_statistics.h"
#include "formats/gpu_shared/records.h"

#include <string>

namespace hearth::viewer
{

/// Culling outcomes. Each cluster or triangle is counted at the first test that it fails: all members but
/// `occlusion_early` add up to `tested`.
struct CullCounts
{
    uint64_t tested = 0;   ///< in the scene
    uint64_t instance = 0; ///< clusters and triangles of culled instances
    uint64_t lod = 0;      ///< not in the cut
    uint64_t frustum = 0;  ///< outside of the frustum
    uint64_t cone = 0;     ///< back-facing
    /// Occluded by the last frame's depth; the late phase draws some of them after all.
    uint64_t occlusion_early = 0;
    uint64_t occlusion = 0; ///< occluded
    uint64_t drawn = 0;
};

struct CullReport
{
    uint64_t empty_instances = 0; ///< instances of meshes without triangles
    CullCounts instances, clusters, triangles;
};

/// Make the report. Triangles of clusters for which the visible list had no slot count as occluded.
CullReport makeCullReport(const shared::CullStatistics& statistics, const shared::FrameCounters& counters,
                          uint64_t early_triangles, uint64_t drawn_triangles);

/// Format as a JSON object.
std::string formatCullReport(const CullReport& report);

} // namespace hearth::viewer
