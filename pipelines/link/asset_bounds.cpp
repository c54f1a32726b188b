// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/link/asset_bounds.h"

#include "formats/codecs/cluster_bounds.h"
#include "formats/pack/pack_check.h"
#include "formats/scene/animation.h"

#include <algorithm>
#include <cmath>

namespace hearth::link
{

using namespace formats;

namespace
{

/// Transforms of the nodes of a source at rest.
class RestPose
{
public:
    /// import_part  has passed checkAnimationTables
    explicit RestPose(const PackView& import_part)
        : tables_(animationTables(import_part)), world_from_node_(tables_.nodes.size())
    {
        poseNodes(tables_, restPose(tables_), nodesParentsFirst(tables_.nodes), world_from_node_);
    }

    /// Return the skinning matrices of a skin at rest (world_from_bind of each joint); empty if there is no
    /// such skin.
    std::vector<Affine3d> skinMatrices(uint32_t skin) const
    {
        if (skin >= tables_.skins.size())
            return {};
        std::vector<Affine3d> world_from_bind(tables_.skins[skin].joints.count);
        skinPalette(tables_, tables_.skins[skin], world_from_node_, world_from_bind);
        return world_from_bind;
    }

private:
    AnimationTables tables_;
    std::vector<Affine3d> world_from_node_;
};

const DeformedMeshRecord* findDeformedMesh(const PackView& skinning_part, uint32_t mesh)
{
    const auto records = skinning_part.deformedMeshes();
    const auto found = std::find_if(records.begin(), records.end(),
                                    [&](const DeformedMeshRecord& record) { return record.mesh == mesh; });
    return found == records.end() ? nullptr : &*found;
}

/// Return the largest absolute morph weight of an instance at rest, which scales the reach of weights from -1
/// to 1.
float maxMorphWeight(const PackView& import_part, const InstanceRecord& instance)
{
    float share = 0;
    if (instance.node < import_part.nodes().size())
        for (const float weight :
             recordsInRange(import_part.morphWeights(), import_part.nodes()[instance.node].morph_weights))
            share = std::max(share, std::abs(weight));
    return share;
}

/// Return the bounds of a deformed mesh: the boxes of its finest clusters, each transformed by all joints
/// that move it, since vertices blend these transforms.
Box3 computeDeformedBounds(const PackView& clusters_part, const PackView& skinning_part,
                           const MeshRecord& mesh, const DeformedMeshRecord& deformed,
                           std::span<const Affine3d> world_from_bind, float max_morph_weight)
{
    const auto clusters = recordsInRange(clusters_part.clusters(), mesh.clusters);
    const auto deformed_clusters = recordsInRange(skinning_part.deformedClusters(), deformed.clusters);
    Box3 bounds;
    for (size_t i = 0; i < std::min(clusters.size(), deformed_clusters.size()); ++i)
    {
        if (clusters[i].level != 0)
            continue;
        const float reach = deformed_clusters[i].morph_reach * max_morph_weight;
        Box3 box = clusterBox(clusters[i], mesh.grid_step);
        box.min -= {reach, reach, reach};
        box.max += {reach, reach, reach};
        const auto add = [&](uint32_t joint)
        {
            // nothing is drawn with a joint whose transform does not fit into floats
            if (joint < world_from_bind.size() && narrowed(world_from_bind[joint]))
                bounds.add(transformBox(world_from_bind[joint], box));
        };
        if (deformed.skin == kInvalidIndex)
            add(0);
        for (const uint32_t entry :
             recordsInRange(skinning_part.clusterJoints(), deformed_clusters[i].joints))
            add(jointIndex(entry));
    }
    return bounds;
}

} // namespace

Result<Box3> computeRestBounds(const PackView& import_part, const PackView& clusters_part,
                               const PackView& skinning_part)
{
    std::optional<RestPose> rest;
    if (!skinning_part.deformedMeshes().empty())
    {
        HEARTH_TRY(checkAnimationTables(import_part));
        rest.emplace(import_part);
    }
    Box3 bounds;
    for (const InstanceRecord& instance : import_part.instances())
    {
        if (instance.mesh >= clusters_part.meshes().size())
            continue;
        const MeshRecord& mesh = clusters_part.meshes()[instance.mesh];
        const Affine3d place = widened(instance.world_from_object);
        const DeformedMeshRecord* deformed = findDeformedMesh(skinning_part, instance.mesh);
        if (deformed != nullptr)
            bounds.add(computeDeformedBounds(
                clusters_part, skinning_part, mesh, *deformed,
                deformed->skin == kInvalidIndex ? std::vector{place} : rest->skinMatrices(deformed->skin),
                maxMorphWeight(import_part, instance)));
        else if (mesh.clusters.count > 0)
            bounds.add(transformBox(place, {mesh.box_min, mesh.box_max}));
    }
    return bounds;
}

} // namespace hearth::link
