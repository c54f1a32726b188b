// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/pose_player.h"

#include <algorithm>
#include <charconv>

namespace hearth::pack
{

PosePlayer::PosePlayer(const formats::PackView& pack)
    : tables_(formats::animationTables(pack)),
      instances_(pack.instances()),
      rest_(formats::restPose(tables_)),
      from_(rest_),
      to_(rest_),
      parents_first_(formats::nodesParentsFirst(tables_.nodes)),
      world_from_node_(tables_.nodes.size())
{
    formats::poseNodes(tables_, rest_, parents_first_, world_from_node_);
    const std::vector<uint8_t> animated = formats::findAnimatedNodes(tables_, parents_first_);
    for (uint32_t i = 0; i < instances_.size(); ++i)
        if (const auto* mesh = findDeformedMesh(pack, instances_[i].mesh))
            addDeformed(i, *mesh, pack.meshes()[mesh->mesh].morph_target_count);
        else if (animated[instances_[i].node] != 0)
            addRigid(i);
    moved_.resize(rigid_.size());
    for (const DeformedInstance& d : deformed_)
        posed_.push_back({d.instance, std::span(palettes_).subspan(d.first_joint, d.joint_count),
                          std::span(weights_).subspan(d.first_weight, d.target_count)});
    apply(rest_);
}

void PosePlayer::addRigid(uint32_t instance)
{
    const formats::InstanceRecord& record = instances_[instance];
    rigid_.push_back(
        {record.node, formats::nodeFromObject(world_from_node_[record.node], record.world_from_object)});
    placed_.push_back({instance, record.world_from_object});
}

void PosePlayer::addDeformed(uint32_t instance, const formats::DeformedMeshRecord& mesh, uint32_t targets)
{
    const formats::InstanceRecord& record = instances_[instance];
    const bool skinned = mesh.skin != kInvalidIndex;
    deformed_.push_back({.instance = instance,
                         .skin = mesh.skin,
                         .node = record.node,
                         .node_from_object = skinned ? Affine3d{}
                                                     : formats::nodeFromObject(world_from_node_[record.node],
                                                                               record.world_from_object),
                         .morph_weights = tables_.nodes[record.node].morph_weights,
                         .first_joint = palettes_.size(),
                         .joint_count = skinned ? tables_.skins[mesh.skin].joints.count : 1,
                         .first_weight = weights_.size(),
                         .target_count = targets});
    palettes_.resize(palettes_.size() + deformed_.back().joint_count);
    weights_.resize(weights_.size() + targets, 0.0f);
}

void PosePlayer::resetTo(formats::ScenePose& pose) const
{
    std::copy(rest_.nodes.begin(), rest_.nodes.end(), pose.nodes.begin());
    std::copy(rest_.morph_weights.begin(), rest_.morph_weights.end(), pose.morph_weights.begin());
}

void PosePlayer::rest()
{
    clips_ = {};
    apply(rest_);
}

void PosePlayer::play(ClipTime clip)
{
    clips_ = {.from = clip};
    resetTo(from_);
    formats::sampleAnimation(tables_, tables_.animations[clip.animation], clip.seconds, from_);
    apply(from_);
}

void PosePlayer::blend(ClipTime from, ClipTime to, double weight)
{
    clips_ = {.from = from, .to = to, .weight = weight};
    resetTo(from_);
    resetTo(to_);
    formats::sampleAnimation(tables_, tables_.animations[from.animation], from.seconds, from_);
    formats::sampleAnimation(tables_, tables_.animations[to.animation], to.seconds, to_);
    formats::blendPoses(from_, to_, weight, from_);
    apply(from_);
}

void PosePlayer::apply(const formats::ScenePose& pose)
{
    formats::poseNodes(tables_, pose, parents_first_, world_from_node_);
    moved_count_ = 0;
    for (size_t i = 0; i < rigid_.size(); ++i)
        placeRigid(i);
    for (const DeformedInstance& deformed : deformed_)
        poseDeformed(deformed, pose);
}

void PosePlayer::poseDeformed(const DeformedInstance& deformed, const formats::ScenePose& pose)
{
    const auto palette = std::span(palettes_).subspan(deformed.first_joint, deformed.joint_count);
    if (deformed.skin != kInvalidIndex)
        formats::skinPalette(tables_, tables_.skins[deformed.skin], world_from_node_, palette);
    else
        palette[0] = world_from_node_[deformed.node] * deformed.node_from_object;
    const uint32_t targets = std::min(deformed.target_count, deformed.morph_weights.count);
    for (uint32_t target = 0; target < targets; ++target)
        weights_[deformed.first_weight + target] =
            static_cast<float>(pose.morph_weights[deformed.morph_weights.first + target]);
}

/// Place a rigid instance. If its transform does not fit into floats, the instance stays where it was.
void PosePlayer::placeRigid(size_t rigid)
{
    MovedInstance& place = placed_[rigid];
    const auto now = narrowed(world_from_node_[rigid_[rigid].node] * rigid_[rigid].node_from_object);
    if (!now || *now == place.world_from_object)
        return;
    place.world_from_object = *now;
    moved_[moved_count_++] = place;
}

const formats::DeformedMeshRecord* findDeformedMesh(const formats::PackView& pack, uint32_t mesh)
{
    const auto meshes = pack.deformedMeshes();
    const auto found = std::lower_bound(meshes.begin(), meshes.end(), mesh,
                                        [](const formats::DeformedMeshRecord& record, uint32_t number)
                                        { return record.mesh < number; });
    return found != meshes.end() && found->mesh == mesh ? &*found : nullptr;
}

std::optional<uint32_t> findAnimation(const formats::PackView& pack, std::string_view name)
{
    for (uint32_t i = 0; i < pack.animations().size(); ++i)
        if (pack.text(pack.animations()[i].name) == name)
            return i;
    uint32_t number = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
    if (error != std::errc() || end != name.data() + name.size() || number >= pack.animations().size())
        return std::nullopt;
    return number;
}

} // namespace hearth::pack
