// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/queries/instance_states.h"

#include <algorithm>
#include <cmath>

namespace hearth::pack
{

namespace
{

template <typename Affine>
bool hasFiniteNumbers(const Affine& transform)
{
    return std::all_of(&transform.m[0][0], &transform.m[0][0] + 12,
                       [](auto value) { return std::isfinite(value); });
}

Error makeStateError(uint32_t instance, std::string detail)
{
    return {Issue::usage, "", "instance " + std::to_string(instance), std::move(detail)};
}

/// Append `count` elements, and return their range.
template <typename T>
formats::Range appendElements(std::vector<T>& elements, size_t count)
{
    const formats::Range range{static_cast<uint32_t>(elements.size()), static_cast<uint32_t>(count)};
    elements.resize(elements.size() + count);
    return range;
}

} // namespace

InstanceStates::InstanceStates(const formats::PackView& pack)
    : pack_(&pack),
      boxes_(pack.instances().size()),
      has_changed_(pack.instances().size()),
      deformed_of_(pack.instances().size(), kInvalidIndex)
{
    for (const formats::InstanceRecord& instance : pack.instances())
        world_from_object_.push_back(instance.world_from_object);
    const PosePlayer at_rest(pack);
    for (const PosedInstance& posed : at_rest.posed())
        addDeformed(posed);
    for (uint32_t i = 0; i < count(); ++i)
        if (!isDeformed(i))
            move(i, world_from_object_[i]);
    has_changed_.assign(count(), false);
    for (const PosedInstance& posed : at_rest.posed())
        pose({posed, false});
}

void InstanceStates::addDeformed(const PosedInstance& posed)
{
    deformed_of_[posed.instance] = static_cast<uint32_t>(deformed_.size());
    deformed_.push_back({.instance = posed.instance,
                         .record = findDeformedMesh(*pack_, pack_->instances()[posed.instance].mesh),
                         .palette = appendElements(palettes_, posed.world_from_bind.size()),
                         .weights = appendElements(weights_, posed.morph_weights.size()),
                         .boxes = appendElements(cluster_boxes_, mesh(posed.instance).clusters.count)});
}

Status InstanceStates::checkMove(uint32_t instance, const Affine3& world_from_object) const
{
    if (instance >= count())
        return makeStateError(instance, "there are " + std::to_string(count()));
    if (isDeformed(instance))
        return makeStateError(instance, "it is deformed: its pose says where it is");
    if (!hasFiniteNumbers(world_from_object))
        return makeStateError(instance, "its new transform is not finite");
    return success();
}

Status InstanceStates::checkPose(const InstancePose& pose) const
{
    const auto& [instance, world_from_bind, morph_weights] = pose.posed;
    if (instance >= count() || !isDeformed(instance))
        return makeStateError(instance, "it has no joints or morph targets that a pose could move");
    const Deformed& deformed = deformed_[deformed_of_[instance]];
    if (world_from_bind.size() != deformed.palette.count || morph_weights.size() != deformed.weights.count)
        return makeStateError(instance, "its pose has " + std::to_string(world_from_bind.size()) +
                                            " joints and " + std::to_string(morph_weights.size()) +
                                            " morph weights, its mesh " +
                                            std::to_string(deformed.palette.count) + " and " +
                                            std::to_string(deformed.weights.count));
    if (!std::all_of(world_from_bind.begin(), world_from_bind.end(), hasFiniteNumbers<Affine3d>) ||
        !std::all_of(morph_weights.begin(), morph_weights.end(),
                     [](float weight) { return std::isfinite(weight); }))
        return makeStateError(instance, "its pose has numbers that are not finite");
    return success();
}

void InstanceStates::move(uint32_t instance, const Affine3& world_from_object)
{
    world_from_object_[instance] = world_from_object;
    has_changed_[instance] = true;
    const formats::MeshRecord& record = mesh(instance);
    if (record.clusters.count > 0)
        boxes_[instance] = transformBox(widened(world_from_object), {record.box_min, record.box_max});
}

void InstanceStates::pose(const InstancePose& pose)
{
    Deformed& deformed = deformed_[deformed_of_[pose.posed.instance]];
    std::copy(pose.posed.world_from_bind.begin(), pose.posed.world_from_bind.end(),
              palettes_.begin() + deformed.palette.first);
    std::copy(pose.posed.morph_weights.begin(), pose.posed.morph_weights.end(),
              weights_.begin() + deformed.weights.first);
    deformed.is_free = pose.is_free;
    deformed.has_boxes = false;
    place(deformed);
}

/// Find the box of an instance in its pose.
void InstanceStates::place(Deformed& deformed)
{
    has_changed_[deformed.instance] = true;
    Box3& box = boxes_[deformed.instance];
    box = {};
    if (deformed.boxes.count == 0)
        return;
    if (!deformed.is_free)
    {
        box = transformBox(palette(deformed)[deformed.record->anchor],
                           {deformed.record->box_min, deformed.record->box_max});
        return;
    }
    findClusterBoxes(deformed);
    for (const Box3& cluster : std::span(cluster_boxes_).subspan(deformed.boxes.first, deformed.boxes.count))
        box.add(cluster);
}

PosedInstance InstanceStates::posed(uint32_t instance) const
{
    const Deformed& deformed = deformed_[deformed_of_[instance]];
    return {instance, palette(deformed),
            std::span(weights_).subspan(deformed.weights.first, deformed.weights.count)};
}

const Box3& InstanceStates::posedClusterBox(uint32_t instance, uint32_t cluster)
{
    Deformed& deformed = deformed_[deformed_of_[instance]];
    if (!deformed.has_boxes)
        findClusterBoxes(deformed);
    return cluster_boxes_[deformed.boxes.first + cluster];
}

void InstanceStates::findClusterBoxes(Deformed& deformed)
{
    for (uint32_t c = 0; c < deformed.boxes.count; ++c)
        cluster_boxes_[deformed.boxes.first + c] = findClusterBox(deformed, c);
    deformed.has_boxes = true;
}

/// A vertex is a convex combination of its places under the joints that move it, so in a free pose the
/// cluster is inside of the union of its bind box under each of them.
Box3 InstanceStates::findClusterBox(const Deformed& deformed, uint32_t cluster) const
{
    const formats::DeformedClusterRecord& record =
        pack_->deformedClusters()[deformed.record->clusters.first + cluster];
    const auto joints = recordsInRange(pack_->clusterJoints(), record.joints);
    const std::span<const Affine3d> transforms = palette(deformed);
    if (!deformed.is_free)
        return transformBox(formats::clusterFrame(transforms, record, joints),
                            {record.box_min, record.box_max});
    const formats::MeshRecord& mesh_record = mesh(deformed.instance);
    Box3 bind =
        formats::clusterBox(pack_->clusters()[mesh_record.clusters.first + cluster], mesh_record.grid_step);
    float weight = 1;
    for (uint32_t i = 0; i < deformed.weights.count; ++i)
        weight = std::max(weight, std::abs(weights_[deformed.weights.first + i]));
    const float reach = record.morph_reach * weight;
    bind.min -= {reach, reach, reach};
    bind.max += {reach, reach, reach};
    if (joints.empty())
        return transformBox(transforms[0], bind);
    Box3 box;
    for (const uint32_t entry : joints)
        box.add(transformBox(transforms[formats::jointIndex(entry)], bind));
    return box;
}

} // namespace hearth::pack
