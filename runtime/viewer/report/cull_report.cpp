// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/report/cull_report.h"

#include <array>

namespace hearth::viewer
{

namespace
{

using Outcomes = std::array<uint64_t, shared::kOutcomeCount>;

/// early, drawn  clusters or triangles of the visible list
CullCounts makeCounts(const Outcomes& outcomes, uint64_t early, uint64_t drawn)
{
    CullCounts counts;
    for (const uint64_t count : outcomes)
        counts.tested += count;
    counts.instance = outcomes[shared::kOutcomeInstance];
    counts.lod = outcomes[shared::kOutcomeLod];
    counts.frustum = outcomes[shared::kOutcomeFrustum];
    counts.cone = outcomes[shared::kOutcomeCone];
    counts.occlusion_early = outcomes[shared::kOutcomeCandidate] - early;
    counts.occlusion = outcomes[shared::kOutcomeCandidate] + outcomes[shared::kOutcomeLateCandidate] - drawn;
    counts.drawn = drawn;
    return counts;
}

std::string format(std::initializer_list<std::pair<const char*, uint64_t>> members)
{
    std::string text;
    for (const auto& [name, count] : members)
        text += (text.empty() ? "{\"" : ",\"") + std::string(name) + "\":" + std::to_string(count);
    return text + "}";
}

std::string formatInstances(const CullCounts& counts, uint64_t empty)
{
    return format({{"tested", counts.tested},
                   {"empty", empty},
                   {"frustum", counts.frustum},
                   {"occlusion_early", counts.occlusion_early},
                   {"occlusion", counts.occlusion},
                   {"drawn", counts.drawn}});
}

std::string formatParts(const CullCounts& counts)
{
    return format({{"tested", counts.tested},
                   {"instance", counts.instance},
                   {"lod", counts.lod},
                   {"frustum", counts.frustum},
                   {"cone", counts.cone},
                   {"occlusion_early", counts.occlusion_early},
                   {"occlusion", counts.occlusion},
                   {"drawn", counts.drawn}});
}

} // namespace

CullReport makeCullReport(const shared::CullStatistics& statistics, const shared::FrameCounters& counters,
                          uint64_t early_triangles, uint64_t drawn_triangles)
{
    Outcomes clusters, triangles;
    for (uint32_t i = 0; i < shared::kOutcomeCount; ++i)
    {
        clusters[i] = statistics.clusters[i];
        triangles[i] = uint64_t{statistics.triangles_high[i]} << 32 | statistics.triangles_low[i];
    }
    CullReport report;
    report.clusters = makeCounts(clusters, counters.early_clusters, counters.drawn_clusters);
    report.triangles = makeCounts(triangles, early_triangles, drawn_triangles);
    report.empty_instances = statistics.empty_instances;
    CullCounts& instances = report.instances;
    instances.frustum = statistics.outside_instances;
    instances.occlusion = statistics.occluded_instances;
    instances.occlusion_early = instances.occlusion + statistics.late_instances;
    instances.drawn = uint64_t{statistics.visible_instances} + statistics.late_instances;
    instances.tested = report.empty_instances + instances.frustum + instances.occlusion + instances.drawn;
    return report;
}

std::string formatCullReport(const CullReport& report)
{
    return "{\"instances\":" + formatInstances(report.instances, report.empty_instances) +
           ",\n  \"clusters\":" + formatParts(report.clusters) +
           ",\n  \"triangles\":" + formatParts(report.triangles) + "}";
}

} // namespace hearth::viewer
