// States of the instances of a pack, for queries: transforms of rigid ones and poses of deformed ones,
// with their bounds in the world.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/pack/pose_player.h"

#include <span>
#include <vector>

namespace hearth::pack
{

/// New pose of a deformed instance; as hearth_pose.
struct InstancePose
{
    PosedInstance posed;
    bool is_free = false; ///< no pose of the clips, nor a blend of two: the cooked bounds do not hold
};

/// States of all instances, at rest at first. Only the constructor allocates.
class InstanceStates
{
public:
    /// pack  checked; outlives the states
    explicit InstanceStates(const formats::PackView& pack);

    /// errors: usage, where there is no such instance, it is deformed, or the transform is not finite.
    Status checkMove(uint32_t instance, const Affine3& world_from_object) const;
    /// errors: usage, where the instance is rigid or the pose does not fit its mesh or is not finite.
    Status checkPose(const InstancePose& pose) const;

    /// Take a move or a pose that has been checked.
    void move(uint32_t instance, const Affine3& world_from_object);
    void pose(const InstancePose& pose);

    const formats::PackView& pack() const { return *pack_; }
    uint32_t count() const { return static_cast<uint32_t>(boxes_.size()); }
    const formats::MeshRecord& mesh(uint32_t instance) const
    {
        return pack_->meshes()[pack_->instances()[instance].mesh];
    }

    /// Return the box of an instance in the world; empty where it has nothing to draw. For a pose of the
    /// clips it is around the whole mesh in all poses about the anchor's place in this one.
    const Box3& box(uint32_t instance) const { return boxes_[instance]; }

    bool isDeformed(uint32_t instance) const { return deformed_of_[instance] != kInvalidIndex; }
    /// True for instances that are deformed or have moved.
    bool hasChanged(uint32_t instance) const { return has_changed_[instance]; }

    /// Return the transform of a rigid instance.
    const Affine3& worldFromObject(uint32_t instance) const { return world_from_object_[instance]; }

    /// Return the pose of a deformed instance.
    PosedInstance posed(uint32_t instance) const;

    /// Return the box of a cluster of a deformed instance in its pose, in the world.
    /// cluster  number in its mesh
    const Box3& posedClusterBox(uint32_t instance, uint32_t cluster);

private:
    struct Deformed
    {
        uint32_t instance;
        const formats::DeformedMeshRecord* record;
        formats::Range palette, weights, boxes; ///< of the vectors below
        bool is_free = false;
        bool has_boxes = false; ///< cluster_boxes_ are of this pose
    };
    void addDeformed(const PosedInstance& posed);
    void place(Deformed& deformed);
    void findClusterBoxes(Deformed& deformed);
    Box3 findClusterBox(const Deformed& deformed, uint32_t cluster) const;
    std::span<const Affine3d> palette(const Deformed& deformed) const
    {
        return std::span(palettes_).subspan(deformed.palette.first, deformed.palette.count);
    }

    const formats::PackView* pack_;
    std::vector<Affine3> world_from_object_;
    std::vector<Box3> boxes_;
    std::vector<bool> has_changed_;
    std::vector<uint32_t> deformed_of_; ///< index in deformed_, or none, for each instance
    std::vector<Deformed> deformed_;
    std::vector<Affine3d> palettes_;
    std::vector<float> weights_;
    std::vector<Box3> cluster_boxes_;
};

} // namespace hearth::pack
