// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/program/statistics.h"

#include "cook/json/json.h"
#include "formats/base/assert.h"
#include "formats/pack/pack_view.h"

#include <cmath>

namespace hearth::clusters
{

using namespace formats;

namespace
{

/// Compute the errors of the groups that the level's clusters were made from; 0 at level 0.
ErrorStatistics errorStatistics(const Hierarchy& hierarchy, const LevelRecord& level,
                                float GroupRecord::*error)
{
    ErrorStatistics errors;
    for (const ClusterRecord& cluster :
         recordsInRange(std::span<const ClusterRecord>(hierarchy.clusters), level.clusters))
    {
        if (cluster.refined_group == kInvalidIndex)
            continue;
        const double value{hierarchy.groups[cluster.refined_group].*error};
        errors.max = std::max(errors.max, value);
        errors.mean += value * cluster.triangle_count;
    }
    HEARTH_ASSERT(level.triangle_count > 0);
    errors.mean /= level.triangle_count;
    return errors;
}

LevelStatistics levelStatistics(const Hierarchy& hierarchy, const LevelRecord& level)
{
    LevelStatistics statistics;
    statistics.clusters = level.clusters.count;
    statistics.triangles = level.triangle_count;
    statistics.error = errorStatistics(hierarchy, level, &GroupRecord::error);
    statistics.position = errorStatistics(hierarchy, level, &GroupRecord::position_error);
    statistics.normal = errorStatistics(hierarchy, level, &GroupRecord::normal_error);
    statistics.uv = errorStatistics(hierarchy, level, &GroupRecord::uv_error);
    statistics.fill = static_cast<double>(statistics.triangles) /
                      (static_cast<double>(statistics.clusters) * kMaxClusterTriangles);
    return statistics;
}

/// Count the triangles that are drawn at a level: its clusters, and the roots of finer levels.
TargetStatistics targetStatistics(const Hierarchy& hierarchy, const LevelTarget& target)
{
    TargetStatistics statistics{target.level, target.triangles, std::nullopt};
    if (target.level >= hierarchy.levels.size())
        return statistics;
    statistics.triangles = hierarchy.levels[target.level].triangle_count;
    for (const ClusterRecord& cluster : hierarchy.clusters)
        if (cluster.level < target.level && std::isinf(hierarchy.groups[cluster.group].error))
            *statistics.triangles += cluster.triangle_count;
    return statistics;
}

double ratio(uint64_t part, uint64_t whole)
{
    return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

Json errorJson(const ErrorStatistics& error)
{
    return {{"max", error.max}, {"mean", error.mean}};
}

Json levelJson(const LevelStatistics& level)
{
    return {{"clusters", level.clusters},
            {"triangles", level.triangles},
            {"fill", level.fill},
            {"max_error", level.error.max},
            {"mean_error", level.error.mean},
            {"position_error", errorJson(level.position)},
            {"normal_error", errorJson(level.normal)},
            {"uv_error", errorJson(level.uv)}};
}

Json targetJson(const TargetStatistics& target)
{
    Json json{{"level", target.level}, {"wanted", target.wanted}, {"triangles", nullptr}};
    if (target.triangles)
        json["triangles"] = *target.triangles;
    return json;
}

Json countsJson(const BuildCounts& counts)
{
    return {{"permissive", counts.permissive_groups},
            {"pruned", counts.pruned_groups},
            {"merged", counts.merged_groups},
            {"retried", counts.retried_groups},
            {"stuck", counts.stuck_groups}};
}

Json bytesJson(const MeshStatistics& mesh)
{
    return {{"pages", mesh.page_bytes},
            {"pages_stored", mesh.stored_page_bytes},
            {"pages_per_triangle", ratio(mesh.page_bytes, mesh.source_triangles)},
            {"pages_stored_per_triangle", ratio(mesh.stored_page_bytes, mesh.source_triangles)}};
}

Json discreteLodsJson(const DiscreteLodStatistics& manual)
{
    Json lods = Json::array();
    for (const DiscreteLod& lod : manual.chain.lods)
        lods.push_back({{"triangles", lod.triangles}, {"vertices", lod.vertices}});
    return {{"lods", lods},
            {"bytes", manual.chain.bytes},
            {"bytes_zstd", manual.chain.bytes_zstd},
            {"hierarchy_bytes", manual.hierarchy_bytes},
            {"hierarchy_of_bytes", ratio(manual.hierarchy_bytes, manual.chain.bytes)},
            {"hierarchy_of_bytes_zstd", ratio(manual.hierarchy_bytes, manual.chain.bytes_zstd)}};
}

/// Sum over all meshes that were measured.
Json totalsJson(std::span<const MeshStatistics> meshes)
{
    uint64_t triangles = 0;
    bool has_discrete_lods = false;
    DiscreteLodStatistics total;
    for (const MeshStatistics& mesh : meshes)
    {
        triangles += mesh.source_triangles;
        if (!mesh.discrete_lods)
            continue;
        has_discrete_lods = true;
        total.chain.bytes += mesh.discrete_lods->chain.bytes;
        total.chain.bytes_zstd += mesh.discrete_lods->chain.bytes_zstd;
        total.hierarchy_bytes += mesh.discrete_lods->hierarchy_bytes;
    }
    Json totals{{"triangles", triangles}};
    if (has_discrete_lods)
        totals["discrete_lods"] = discreteLodsJson(total);
    if (has_discrete_lods)
        totals["discrete_lods"].erase("lods");
    return totals;
}

Json meshJson(const MeshStatistics& mesh)
{
    Json json{
        {"index", mesh.index},
        {"name", mesh.name},
        {"source", {{"triangles", mesh.source_triangles}, {"vertices", mesh.source_vertices}}},
        {"degenerate_triangles", mesh.degenerate_triangles},
        {"levels", Json::array()},
        {"groups", mesh.groups},
        {"clusters", mesh.clusters},
        {"pages", mesh.pages},
        {"groups_by_outcome", countsJson(mesh.counts)},
        {"loose_pieces", mesh.counts.loose_pieces},
        {"lost_influences",
         {{"vertices", mesh.counts.influence_loss.vertex_count},
          {"most_weight", mesh.counts.influence_loss.max_weight},
          {"mean_weight", mesh.counts.influence_loss.mean_weight},
          {"displacement",
           mesh.counts.influence_displacement ? Json(*mesh.counts.influence_displacement) : Json(nullptr)}}},
        {"bytes", bytesJson(mesh)}};
    for (const LevelStatistics& level : mesh.levels)
        json["levels"].push_back(levelJson(level));
    if (!mesh.targets.empty())
        json["targets"] = Json::array();
    for (const TargetStatistics& target : mesh.targets)
        json["targets"].push_back(targetJson(target));
    if (!mesh.authored_levels.empty())
        json["authored_levels"] = Json::array();
    for (const uint32_t level : mesh.authored_levels)
        json["authored_levels"].push_back(level == kInvalidIndex ? Json(nullptr) : Json(level));
    if (mesh.discrete_lods)
        json["discrete_lods"] = discreteLodsJson(*mesh.discrete_lods);
    if (mesh.seconds)
        json["seconds"] = *mesh.seconds;
    return json;
}

} // namespace

bool TargetStatistics::met() const
{
    return triangles && std::abs(static_cast<double>(*triangles) - static_cast<double>(wanted)) <=
                            0.03 * static_cast<double>(wanted);
}

MeshStatistics collectStatistics(const Hierarchy& hierarchy, const Config& config, uint32_t index,
                                 std::string name)
{
    MeshStatistics statistics;
    statistics.index = index;
    statistics.name = std::move(name);
    statistics.source_triangles = hierarchy.mesh.source_triangles;
    statistics.source_vertices = hierarchy.mesh.source_vertices;
    statistics.degenerate_triangles = hierarchy.mesh.degenerate_triangles;
    statistics.groups = static_cast<uint32_t>(hierarchy.groups.size());
    statistics.clusters = static_cast<uint32_t>(hierarchy.clusters.size());
    statistics.pages = static_cast<uint32_t>(hierarchy.pages.size());
    for (const PageRecord& page : hierarchy.pages)
    {
        statistics.page_bytes += page.size;
        statistics.stored_page_bytes += page.stored_size;
    }
    for (const LevelRecord& level : hierarchy.levels)
        statistics.levels.push_back(levelStatistics(hierarchy, level));
    for (const LevelTarget& target : config.reduction.targets)
        statistics.targets.push_back(targetStatistics(hierarchy, target));
    statistics.authored_levels = hierarchy.authored_levels;
    statistics.counts = hierarchy.counts;
    return statistics;
}

std::string statisticsJson(const std::string& source, std::span<const MeshStatistics> meshes)
{
    Json json{{"schema", "hearth.clusters/1"},
              {"tool_version", HEARTH_VERSION},
              {"source", source},
              {"meshes", Json::array()}};
    for (const MeshStatistics& mesh : meshes)
        json["meshes"].push_back(meshJson(mesh));
    json["totals"] = totalsJson(meshes);
    return json.dump(2) + "\n";
}

} // namespace hearth::clusters
