// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/scene_boxes.h"

#include "formats/cluster_bounds.h"

#include <algorithm>

namespace hearth::gpu
{

namespace
{

/// For each instance.
std::vector<Affine3> placesOf(const formats::PackView& pack, const pack::PosePlayer& player)
{
    std::vector<Affine3> places;
    places.reserve(pack.instances().size());
    for (const formats::InstanceRecord& instance : pack.instances())
        places.push_back(instance.world_from_object);
    for (const pack::MovedInstance& moved : player.places())
        places[moved.instance] = moved.world_from_object;
    return places;
}

/// Of a joint whose place does not fit into floats, nothing is drawn.
void addCarried(const Box3& box, const Affine3d& world_from_bind, std::vector<PlacedBox>& boxes)
{
    if (const auto place = narrowed(world_from_bind); place && !box.empty())
        boxes.push_back({box, *place});
}

/// Calls rigid(mesh, place) and deformed(mesh, record of DMSH, palette) for the instances that have clusters.
template <typename Rigid, typename Deformed>
void visitInstances(const formats::PackView& pack, const pack::PosePlayer& player, const Rigid& rigid,
                    const Deformed& deformed)
{
    const std::vector<Affine3> places = placesOf(pack, player);
    auto posed = player.posed().begin();
    for (uint32_t i = 0; i < places.size(); ++i)
    {
        const uint32_t number = pack.instances()[i].mesh;
        const formats::MeshRecord& mesh = pack.meshes()[number];
        const bool is_posed = posed != player.posed().end() && posed->instance == i;
        if (mesh.clusters.count > 0 && !is_posed)
            rigid(mesh, places[i]);
        else if (mesh.clusters.count > 0)
            deformed(mesh, *pack::findDeformedMesh(pack, number), posed->world_from_bind);
        posed += is_posed ? 1 : 0;
    }
}

} // namespace

std::vector<PlacedBox> instanceBoxes(const formats::PackView& pack, const pack::PosePlayer& player)
{
    std::vector<PlacedBox> boxes;
    visitInstances(
        pack, player,
        [&](const formats::MeshRecord& mesh, const Affine3& place) {
            boxes.push_back({{mesh.box_min, mesh.box_max}, place});
        },
        [&](const formats::MeshRecord&, const formats::DeformedMeshRecord& mesh,
            std::span<const Affine3d> palette) {
            addCarried({mesh.box_min, mesh.box_max}, palette[mesh.anchor], boxes);
        });
    return boxes;
}

std::vector<PlacedBox> clusterBoxes(const formats::PackView& pack, const pack::PosePlayer& player)
{
    std::vector<PlacedBox> boxes;
    visitInstances(
        pack, player,
        [&](const formats::MeshRecord& mesh, const Affine3& place)
        {
            for (const formats::ClusterRecord& cluster : recordsOf(pack.clusters(), mesh.clusters))
                if (cluster.level == 0)
                    boxes.push_back({formats::boxOf(cluster, mesh.grid_step), place});
        },
        [&](const formats::MeshRecord& mesh, const formats::DeformedMeshRecord& deformed,
            std::span<const Affine3d> palette)
        {
            for (uint32_t c = 0; c < mesh.clusters.count; ++c)
                if (pack.clusters()[mesh.clusters.first + c].level == 0)
                {
                    const auto& cluster = pack.deformedClusters()[deformed.clusters.first + c];
                    addCarried({cluster.box_min, cluster.box_max}, palette[cluster.joint], boxes);
                }
        });
    return boxes;
}

Box3 sceneBounds(const formats::PackView& pack, const pack::PosePlayer& player)
{
    Box3 bounds;
    for (const PlacedBox& placed : instanceBoxes(pack, player))
        for (int corner = 0; corner < 8; ++corner)
            bounds.add(
                transformPoint(placed.world_from_box, {(corner & 1) ? placed.box.max.x : placed.box.min.x,
                                                       (corner & 2) ? placed.box.max.y : placed.box.min.y,
                                                       (corner & 4) ? placed.box.max.z : placed.box.min.z}));
    return bounds;
}

Box3 sceneBounds(const formats::PackView& pack)
{
    return sceneBounds(pack, pack::PosePlayer(pack));
}

} // namespace hearth::gpu
