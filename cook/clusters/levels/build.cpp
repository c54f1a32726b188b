// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/core/hierarchy.h"
#include "cook/clusters/levels/levels.h"
#include "cook/clusters/levels/records.h"
#include "formats/base/assert.h"
#include "formats/codecs/cluster_bounds.h"

namespace hearth::clusters
{

using namespace formats;

namespace
{

void countOutcomes(const Build& build, BuildCounts& counts)
{
    for (const Level& level : build.levels)
        for (const LevelGroup& group : level.built)
        {
            counts.permissive_groups += group.outcome.permissive ? 1 : 0;
            counts.pruned_groups += group.outcome.pruned ? 1 : 0;
            counts.merged_groups += group.outcome.merged ? 1 : 0;
            counts.retried_groups += group.retried ? 1 : 0;
            counts.stuck_groups += group.stuck ? 1 : 0;
            counts.loose_pieces += group.outcome.loose_pieces;
        }
}

void fillSourceCounts(const mesh::SourceMesh& source, MeshRecord& mesh)
{
    mesh.source_faces = source.face_count;
    mesh.source_triangles = static_cast<uint32_t>(source.triangleCount());
    mesh.source_vertices = source.source_vertex_count;
    mesh.skinned = source.joint_sets.empty() ? 0 : 1;
    mesh.morph_target_count = static_cast<uint32_t>(source.morph_targets.size());
}

void fillMeshRecord(const PreparedMesh& prepared, Hierarchy& hierarchy)
{
    MeshRecord& mesh = hierarchy.mesh;
    mesh.grid_error = prepared.grid.error;
    mesh.degenerate_triangles = prepared.degenerate_count;
    mesh.lod_count = static_cast<uint32_t>(hierarchy.levels.size());
    mesh.levels = {0, mesh.lod_count};
    mesh.groups = {0, static_cast<uint32_t>(hierarchy.groups.size())};
    mesh.clusters = {0, static_cast<uint32_t>(hierarchy.clusters.size())};
    mesh.pages = {0, static_cast<uint32_t>(hierarchy.pages.size())};
    Box3 box;
    for (const ClusterRecord& cluster : hierarchy.clusters)
        box.add(clusterBox(cluster, mesh.grid_step));
    mesh.box_min = box.empty() ? Float3{} : box.min;
    mesh.box_max = box.empty() ? Float3{} : box.max;
}

} // namespace

Hierarchy buildHierarchy(mesh::SourceMesh source, std::span<const mesh::SourceMesh> authored,
                         const Config& config, const MeshMotion* motion)
{
    Hierarchy hierarchy;
    fillSourceCounts(source, hierarchy.mesh);
    JoinedMesh joined = joinAuthored(std::move(source), authored, config.influences, motion);
    Build build{std::move(joined.mesh),
                config,
                {},
                joined.levels,
                std::vector<uint32_t>(authored.size(), kInvalidIndex)};
    if (config.visibility && (build.mesh.attributes & kVertexNormal))
        build.mesh.attributes |= kVertexVisibility;
    build.mesh.read_uv_sets = config.read_uv_sets;
    hierarchy.counts.influence_loss = build.mesh.influence_loss;
    hierarchy.counts.influence_displacement = build.mesh.influence_displacement;
    HEARTH_ASSERT(joined.levels.size() <= authored.size());
    if (build.mesh.triangleCount() > 0)
    {
        buildLevels(build);
        countOutcomes(build, hierarchy.counts);
        writeRecords(build, hierarchy);
    }
    hierarchy.authored_levels = std::move(build.level_of_authored);
    HEARTH_ASSERT(hierarchy.authored_levels.size() == authored.size());
    fillMeshRecord(build.mesh, hierarchy);
    return hierarchy;
}

Hierarchy buildHierarchy(mesh::SourceMesh source, const Config& config, const MeshMotion* motion)
{
    return buildHierarchy(std::move(source), {}, config, motion);
}

} // namespace hearth::clusters
