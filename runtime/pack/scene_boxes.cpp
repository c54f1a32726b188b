// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/scene_boxes.h"

#include "formats/codecs/cluster_bounds.h"

#include <algorithm>

namespace hearth::pack
{

namespace
{

/// Transforms of all instances in the pose of the player.
std::vector<Affine3> computeTransforms(const formats::PackView& pack, const PosePlayer& player)
{
    std::vector<Affine3> transforms;
    transforms.reserve(pack.instances().size());
    for (const formats::InstanceRecord& instance : pack.instances())
        transforms.push_back(instance.world_from_object);
    for (const MovedInstance& moved : player.transforms())
        transforms[moved.instance] = moved.world_from_object;
    return transforms;
}

/// Add a box in the space of a joint. Skips joints whose transform does not fit into floats: nothing of them
/// is drawn.
void addTransformed(const Box3& box, const Affine3d& world_from_bind, std::vector<TransformedBox>& boxes)
{
    if (const auto place = narrowed(world_from_bind); place && !box.empty())
        boxes.push_back({box, *place});
}

/// Call rigid(mesh, place) and deformed(mesh, record of DMSH, pose) for the instances of the range that have
/// clusters.
template <typename Rigid, typename Deformed>
void visitInstances(const formats::PackView& pack, const PosePlayer& player, formats::Range instances,
                    const Rigid& rigid, const Deformed& deformed)
{
    const std::vector<Affine3> transforms = computeTransforms(pack, player);
    // ascending by instance
    auto posed = std::find_if(player.posed().begin(), player.posed().end(),
                              [&](const PosedInstance& p) { return p.instance >= instances.first; });
    for (uint32_t i = instances.first; i < instances.first + instances.count; ++i)
    {
        const uint32_t number = pack.instances()[i].mesh;
        const formats::MeshRecord& mesh = pack.meshes()[number];
        const bool is_posed = posed != player.posed().end() && posed->instance == i;
        if (mesh.clusters.count > 0 && !is_posed)
            rigid(mesh, transforms[i]);
        else if (mesh.clusters.count > 0)
            deformed(mesh, *findDeformedMesh(pack, number), *posed);
        posed += is_posed ? 1 : 0;
    }
}

// Posing takes about 0.1 ms per cluster: more clusters take too long.
constexpr size_t kMaxPosedClusters = 8192;

size_t countDeformedClusters(const formats::PackView& pack, const PosePlayer& player,
                             formats::Range instances)
{
    size_t count = 0;
    for (const PosedInstance& posed : player.posed())
        if (posed.instance >= instances.first && posed.instance - instances.first < instances.count)
            count += pack.meshes()[pack.instances()[posed.instance].mesh].clusters.count;
    return count;
}

Affine3d blendedJoints(const formats::ClusterGeometry& geometry, uint32_t vertex,
                       std::span<const Affine3d> palette)
{
    if (geometry.influenceCount() == 0)
        return palette[0];
    const auto joints = geometry.joints(vertex);
    const auto codes = geometry.weightCodes(vertex);
    Affine3d blended{};
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column)
        {
            double& sum = blended.m[row][column];
            sum = 0;
            for (size_t i = 0; i < geometry.influenceCount(); ++i)
                sum += codes[i] / 65535.0 * palette[joints[i]].m[row][column];
        }
    return blended;
}

/// Bounds of the posed clusters in world space.
Box3 posedBox(const formats::ClusterGeometry& geometry, const PosedInstance& pose)
{
    Box3 box;
    for (uint32_t v = 0; v < geometry.vertexCount(); ++v)
        box.add(narrow(posedPosition(geometry, v, pose)));
    return box;
}

/// Add boxes of the finest clusters of an instance in its pose. Skips pages that cannot be decoded.
void addPosed(const formats::PackView& pack, const PosedInstance& pose, std::vector<TransformedBox>& boxes)
{
    const formats::MeshRecord& mesh = pack.meshes()[pack.instances()[pose.instance].mesh];
    for (uint32_t page = mesh.pages.first; page < mesh.pages.first + mesh.pages.count; ++page)
    {
        const auto bytes = pack.decodePage(page);
        if (!bytes.ok())
            continue;
        for (const formats::ClusterRecord& cluster :
             recordsInRange(pack.clusters(), pack.pages()[page].clusters))
            if (cluster.level == 0)
                if (const auto geometry = formats::ClusterGeometry::at(*bytes, cluster, mesh))
                    boxes.push_back({posedBox(*geometry, pose), Affine3{}});
    }
}

} // namespace

Double3 posedPosition(const formats::ClusterGeometry& geometry, uint32_t vertex, const PosedInstance& pose)
{
    Double3 bind = widen(geometry.position(vertex));
    for (uint32_t i = 0; i < geometry.morphCount(); ++i)
        bind = bind +
               widen(geometry.morphPosition(i, vertex)) * double{pose.morph_weights[geometry.morphTarget(i)]};
    return transformPoint(blendedJoints(geometry, vertex, pose.world_from_bind), bind);
}

formats::Range allInstances(const formats::PackView& pack)
{
    return {0, static_cast<uint32_t>(pack.instances().size())};
}

std::vector<TransformedBox> instanceBoxes(const formats::PackView& pack, const PosePlayer& player,
                                          formats::Range instances)
{
    std::vector<TransformedBox> boxes;
    visitInstances(
        pack, player, instances,
        [&](const formats::MeshRecord& mesh, const Affine3& place) {
            boxes.push_back({{mesh.box_min, mesh.box_max}, place});
        },
        [&](const formats::MeshRecord&, const formats::DeformedMeshRecord& mesh, const PosedInstance& pose) {
            addTransformed({mesh.box_min, mesh.box_max}, pose.world_from_bind[mesh.anchor], boxes);
        });
    return boxes;
}

std::vector<TransformedBox> clusterBoxes(const formats::PackView& pack, const PosePlayer& player,
                                         formats::Range instances)
{
    std::vector<TransformedBox> boxes;
    const bool in_pose = countDeformedClusters(pack, player, instances) <= kMaxPosedClusters;
    visitInstances(
        pack, player, instances,
        [&](const formats::MeshRecord& mesh, const Affine3& place)
        {
            for (const formats::ClusterRecord& cluster : recordsInRange(pack.clusters(), mesh.clusters))
                if (cluster.level == 0)
                    boxes.push_back({formats::clusterBox(cluster, mesh.grid_step), place});
        },
        [&](const formats::MeshRecord& mesh, const formats::DeformedMeshRecord& deformed,
            const PosedInstance& pose)
        {
            if (in_pose)
                return addPosed(pack, pose, boxes);
            for (uint32_t c = 0; c < mesh.clusters.count; ++c)
                if (pack.clusters()[mesh.clusters.first + c].level == 0)
                {
                    const auto& cluster = pack.deformedClusters()[deformed.clusters.first + c];
                    const auto joints = recordsInRange(pack.clusterJoints(), cluster.joints);
                    addTransformed({cluster.box_min, cluster.box_max},
                                   formats::clusterFrame(pose.world_from_bind, cluster, joints), boxes);
                }
        });
    return boxes;
}

Box3 instanceBounds(const formats::PackView& pack, const PosePlayer& player, formats::Range instances)
{
    Box3 bounds;
    for (const TransformedBox& placed : instanceBoxes(pack, player, instances))
        for (int corner = 0; corner < 8; ++corner)
            bounds.add(
                transformPoint(placed.world_from_box, {(corner & 1) ? placed.box.max.x : placed.box.min.x,
                                                       (corner & 2) ? placed.box.max.y : placed.box.min.y,
                                                       (corner & 4) ? placed.box.max.z : placed.box.min.z}));
    return bounds;
}

Box3 sceneBounds(const formats::PackView& pack, const PosePlayer& player)
{
    return instanceBounds(pack, player, allInstances(pack));
}

Box3 sceneBounds(const formats::PackView& pack)
{
    return sceneBounds(pack, PosePlayer(pack));
}

} // namespace hearth::pack
