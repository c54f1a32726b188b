// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/skinning/skinning_part.h"

#include "cook/json/json.h"
#include "cook/skinning/cluster_bounds.h"
#include "cook/skinning/group_spheres.h"
#include "cook/skinning/read_clusters.h"
#include "formats/container/container_writer.h"
#include "formats/pack/pack_check.h"

#include <algorithm>

namespace hearth::skinning
{

using namespace formats;
using animation_bounds::Box3d;
using animation_bounds::Interval;

namespace
{

struct Tables
{
    std::vector<DeformedMeshRecord> meshes;
    std::vector<DeformedClusterRecord> clusters;
    std::vector<uint32_t> joints;
    std::vector<DeformedGroupRecord> groups;
};

/// Mesh and the nodes that draw it.
struct DrawnMesh
{
    uint32_t mesh = 0;
    uint32_t skin = kInvalidIndex;
    std::vector<uint32_t> nodes;
};

bool isDeformed(const MeshRecord& mesh)
{
    return mesh.clusters.count != 0 && (mesh.skinned != 0 || mesh.morph_target_count != 0);
}

/// Return the deformed meshes with all nodes that draw them.
/// errors: meaning_reference where a node has a missing mesh, or a mesh has two skins or none.
Result<std::vector<DrawnMesh>> drawnMeshes(const PackView& scene, const PackView& part)
{
    std::vector<DrawnMesh> meshes(part.meshes().size());
    for (uint32_t i = 0; i < meshes.size(); ++i)
        meshes[i].mesh = i;
    for (uint32_t i = 0; i < scene.nodes().size(); ++i)
    {
        const NodeRecord& node = scene.nodes()[i];
        if (node.mesh == kInvalidIndex)
            continue;
        const auto fail = [&](std::string detail) {
            return Error{Issue::meaning_reference, scene.name(), "node " + std::to_string(i),
                         std::move(detail)};
        };
        if (node.mesh >= meshes.size())
            return fail("mesh " + std::to_string(node.mesh));
        DrawnMesh& mesh = meshes[node.mesh];
        mesh.nodes.push_back(i);
        if (part.meshes()[node.mesh].skinned == 0)
            continue;
        if (node.skin == kInvalidIndex || (mesh.skin != kInvalidIndex && mesh.skin != node.skin))
            return fail("mesh " + std::to_string(node.mesh) + " is drawn with different skins");
        mesh.skin = node.skin;
    }
    std::erase_if(meshes, [&](const DrawnMesh& mesh)
                  { return mesh.nodes.empty() || !isDeformed(part.meshes()[mesh.mesh]); });
    return meshes;
}

std::vector<Interval> morphWeights(const AnimationTables& tables, const DrawnMesh& mesh, uint32_t targets)
{
    std::vector<Interval> ranges(targets);
    for (const uint32_t node : mesh.nodes)
    {
        const std::vector<Interval> of_node = animation_bounds::morphWeightRanges(tables, node, targets);
        for (size_t i = 0; i < ranges.size(); ++i)
        {
            ranges[i].add(of_node[i].low);
            ranges[i].add(of_node[i].high);
        }
    }
    return ranges;
}

std::vector<Box3d> jointReach(std::span<const DeformedCluster> clusters, uint32_t joints)
{
    std::vector<Box3d> reach(joints);
    for (const DeformedCluster& cluster : clusters)
        for (size_t i = 0; i < cluster.joints.size(); ++i)
            if (cluster.weights[i] > 0)
                animation_bounds::add(reach[cluster.joints[i]],
                                      widen(cluster.positions[i / cluster.influences]));
    return reach;
}

double surface(Float3 low, Float3 high)
{
    const Double3 size = widen(high) - widen(low);
    return size.x * size.y + size.y * size.z + size.z * size.x;
}

MeshStatistics makeStatistics(const PackView& part, const DrawnMesh& drawn,
                              std::span<const DeformedBounds> bounds)
{
    const MeshRecord& mesh = part.meshes()[drawn.mesh];
    MeshStatistics statistics;
    statistics.mesh = drawn.mesh;
    statistics.name = part.text(mesh.name);
    statistics.morph_targets = mesh.morph_target_count;
    statistics.clusters = mesh.clusters.count;
    double growth = 0;
    for (uint32_t i = 0; i < bounds.size(); ++i)
    {
        const DeformedClusterRecord& record = bounds[i].record;
        const Box3 bind = clusterBox(part.clusters()[mesh.clusters.first + i], mesh.grid_step);
        const bool unbounded = record.box_max.x >= kUnbounded;
        statistics.unbounded += unbounded ? 1 : 0;
        statistics.cones += record.cone_cutoff != kNoCone ? 1 : 0;
        statistics.most_joints =
            std::max(statistics.most_joints, static_cast<uint32_t>(bounds[i].joints.size()));
        if (const double before = surface(bind.min, bind.max); before > 0 && !unbounded)
            growth += surface(record.box_min, record.box_max) / before;
    }
    const uint32_t bounded = statistics.clusters - statistics.unbounded;
    statistics.box_growth = bounded == 0 ? 0 : growth / bounded;
    return statistics;
}

void appendTables(Tables& tables, const MeshRecord& mesh, const DrawnMesh& drawn,
                  std::span<const DeformedBounds> clusters, const AnchoredBounds& anchored)
{
    DeformedMeshRecord record{};
    record.mesh = drawn.mesh;
    record.skin = drawn.skin;
    record.anchor = anchored.anchor;
    record.clusters = {static_cast<uint32_t>(tables.clusters.size()), mesh.clusters.count};
    record.box_min = anchored.box.min;
    record.box_max = anchored.box.max;
    tables.meshes.push_back(record);
    for (const DeformedBounds& bounds : clusters)
    {
        DeformedClusterRecord cluster = bounds.record;
        cluster.joints = {static_cast<uint32_t>(tables.joints.size()),
                          static_cast<uint32_t>(bounds.joints.size())};
        tables.clusters.push_back(cluster);
        tables.joints.insert(tables.joints.end(), bounds.joints.begin(), bounds.joints.end());
    }
    for (uint32_t i = 0; i < mesh.groups.count; ++i)
    {
        DeformedGroupRecord group{};
        group.group = mesh.groups.first + i;
        group.sphere_center = anchored.spheres[i].center;
        group.sphere_radius = anchored.spheres[i].radius;
        tables.groups.push_back(group);
    }
}

/// Check the groups of a mesh.
/// errors: meaning_range, meaning_reference where a group's clusters are not the mesh's.
Status checkGroups(const PackView& part, const MeshRecord& mesh, uint32_t number)
{
    const auto fail = [&](Issue issue, const char* detail) {
        return Error{issue, part.name(), "mesh " + std::to_string(number), detail};
    };
    if (!isInsideTable(mesh.groups, part.groups().size()))
        return fail(Issue::meaning_range, "its groups lie outside chunk GRUP");
    const uint32_t end = mesh.clusters.first + mesh.clusters.count;
    for (uint32_t g = 0; g < mesh.groups.count; ++g)
    {
        const GroupRecord& group = part.groups()[mesh.groups.first + g];
        if (group.clusters.first < mesh.clusters.first || group.clusters.count == 0 ||
            group.clusters.count > end - group.clusters.first || group.set_offset > g)
            return fail(Issue::meaning_range, "the clusters of a group are not its own");
        for (uint32_t c = group.clusters.first; c < group.clusters.first + group.clusters.count; ++c)
            // finer groups follow coarser ones in the table
            if (const uint32_t refined = part.clusters()[c].refined_group;
                refined != kInvalidIndex &&
                (refined <= mesh.groups.first + g || refined >= mesh.groups.first + mesh.groups.count))
                return fail(Issue::meaning_reference, "a cluster was made from a group that is not finer");
    }
    return success();
}

Result<MeshStatistics> cookMesh(const PackView& part, const AnimationTables& tables,
                                std::span<const animation_bounds::NodeMotion> nodes,
                                const animation_bounds::PoseRegions* regions, const DrawnMesh& drawn,
                                Tables& written)
{
    const MeshRecord& mesh = part.meshes()[drawn.mesh];
    const uint32_t joints = drawn.skin == kInvalidIndex ? 0 : tables.skins[drawn.skin].joints.count;
    HEARTH_ASSIGN_OR_RETURN(const std::vector<DeformedCluster> clusters,
                            readClusters(part, drawn.mesh, joints));
    HEARTH_TRY(checkGroups(part, mesh, drawn.mesh));
    const std::vector<Interval> morph_weights = morphWeights(tables, drawn, mesh.morph_target_count);
    const std::vector<Box3d> reach = jointReach(clusters, joints);
    std::optional<animation_bounds::SkinMotion> skin;
    if (drawn.skin != kInvalidIndex)
        skin.emplace(tables, nodes, drawn.skin, reach);
    const Deformation deformation{skin ? &*skin : nullptr, morph_weights, regions};
    const std::vector<DeformedBounds> bounds = computeClusterBounds(clusters, deformation);
    const MeshHierarchy hierarchy{part.groups().subspan(mesh.groups.first, mesh.groups.count),
                                  part.clusters().subspan(mesh.clusters.first, mesh.clusters.count),
                                  mesh.groups.first, mesh.clusters.first};
    appendTables(written, mesh, drawn, bounds,
                 computeAnchoredBounds(hierarchy, clusters, deformation, reach));
    MeshStatistics statistics = makeStatistics(part, drawn, bounds);
    statistics.joints = joints;
    return statistics;
}

template <typename T>
Status addTable(ContainerWriter& writer, uint32_t type, const std::vector<T>& records)
{
    return records.empty() ? success() : writer.addRecords<T>(type, records);
}

} // namespace

Result<std::vector<MeshStatistics>>
writeSkinningPart(const PackView& import_part, const PackView& clusters_part, const std::string& output_path)
{
    HEARTH_ASSIGN_OR_RETURN(ContainerWriter writer,
                            ContainerWriter::create(output_path, ContainerKind::part));
    HEARTH_TRY(checkAnimationTables(import_part));
    HEARTH_ASSIGN_OR_RETURN(const std::vector<DrawnMesh> meshes, drawnMeshes(import_part, clusters_part));
    const AnimationTables tables = animationTables(import_part);
    const std::vector<animation_bounds::NodeMotion> nodes =
        meshes.empty() ? std::vector<animation_bounds::NodeMotion>{} : animation_bounds::nodeMotions(tables);
    std::optional<animation_bounds::PoseRegions> regions;
    if (!meshes.empty() && !tables.animations.empty())
        regions.emplace(tables, nodes);
    Tables written;
    std::vector<MeshStatistics> statistics;
    for (const DrawnMesh& mesh : meshes)
    {
        HEARTH_ASSIGN_OR_RETURN(
            MeshStatistics of_mesh,
            cookMesh(clusters_part, tables, nodes, regions ? &*regions : nullptr, mesh, written));
        statistics.push_back(std::move(of_mesh));
    }
    HEARTH_TRY(addTable(writer, kChunkDeformedMeshes, written.meshes));
    HEARTH_TRY(addTable(writer, kChunkDeformedClusters, written.clusters));
    HEARTH_TRY(addTable(writer, kChunkClusterJoints, written.joints));
    HEARTH_TRY(addTable(writer, kChunkDeformedGroups, written.groups));
    HEARTH_TRY(writer.finish());
    return statistics;
}

std::string statisticsJson(const std::string& source, const std::vector<MeshStatistics>& meshes)
{
    Json list = Json::array();
    for (const MeshStatistics& mesh : meshes)
        list.push_back({{"mesh", mesh.mesh},
                        {"name", mesh.name},
                        {"joints", mesh.joints},
                        {"morph_targets", mesh.morph_targets},
                        {"clusters", mesh.clusters},
                        {"cones", mesh.cones},
                        {"unbounded", mesh.unbounded},
                        {"most_joints", mesh.most_joints},
                        {"box_growth", mesh.box_growth}});
    const Json document{{"schema", "hearth.skinning/1"}, {"source", source}, {"meshes", list}};
    return document.dump(2) + "\n";
}

} // namespace hearth::skinning
