// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/program/part_motion.h"

#include <algorithm>

namespace hearth::clusters
{

using namespace formats;

namespace
{

/// Return the bounding box of the vertices of each joint; empty if the mesh refers to a joint that does not
/// exist.
std::vector<animation_bounds::Box3d> jointBoxes(const mesh::SourceMesh& mesh, uint32_t joint_count)
{
    std::vector<animation_bounds::Box3d> reach(joint_count);
    for (size_t set = 0; set < mesh.joint_sets.size(); ++set)
        for (size_t v = 0; v < mesh.vertexCount(); ++v)
        {
            const Float4 w = mesh.weight_sets[set][v];
            const std::array<float, 4> weights{w.x, w.y, w.z, w.w};
            for (size_t i = 0; i < weights.size(); ++i)
            {
                if (!(weights[i] > 0))
                    continue;
                const uint32_t joint = mesh.joint_sets[set][v].joint[i];
                if (joint >= joint_count)
                    return {};
                animation_bounds::add(reach[joint], widen(mesh.positions[v]));
            }
        }
    return reach;
}

} // namespace

PartMotion::PartMotion(PackView view)
    : view_(std::make_shared<const PackView>(std::move(view))),
      tables_(animationTables(*view_)),
      nodes_(animation_bounds::nodeMotions(tables_))
{
}

Result<PartMotion> PartMotion::read(const ContainerReader& part)
{
    HEARTH_ASSIGN_OR_RETURN(PackView view, PackView::read(part));
    return PartMotion(std::move(view));
}

Result<OwnedMotion> PartMotion::meshMotion(uint32_t index, const mesh::SourceMesh& mesh) const
{
    OwnedMotion owned;
    std::vector<float>& most = owned.motion.max_morph_weights;
    most.assign(mesh.morph_targets.size(), 1);
    for (uint32_t node = 0; node < tables_.nodes.size(); ++node)
    {
        if (tables_.nodes[node].mesh != index)
            continue;
        const auto ranges = animation_bounds::morphWeightRanges(tables_, node, most.size());
        for (size_t target = 0; target < most.size(); ++target)
            most[target] = std::max(most[target], static_cast<float>(ranges[target].magnitude()));
        const uint32_t skin = tables_.nodes[node].skin;
        if (owned.skin || mesh.joint_sets.empty() || skin >= tables_.skins.size())
            continue;
        const uint32_t joints = tables_.skins[skin].joints.count;
        const std::vector<animation_bounds::Box3d> reach = jointBoxes(mesh, joints);
        if (reach.empty())
            return Error{Issue::meaning_reference, view_->name(), chunkName(kChunkSourceMesh, index),
                         "a vertex names a joint that its skin has not"};
        owned.skin = std::make_unique<animation_bounds::SkinMotion>(tables_, nodes_, skin, reach);
        owned.motion.skin = owned.skin.get();
    }
    return owned;
}

} // namespace hearth::clusters
