// Plays the clips of a pack: where its rigid instances go, and the palettes of its deformed ones. Thin: one clip or a
// blend of two, for the whole scene; formats/scene/animation.h says what a pose is. No Vulkan.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"
#include "formats/scene/animation.h"

#include <optional>
#include <span>
#include <vector>

namespace hearth::pack
{

/// A moment of a clip. Before its first and after its last key a clip rests: whoever wants it to repeat wraps the time.
struct ClipTime
{
    uint32_t animation = 0; ///< of the pack
    double seconds = 0;
};

/// A rigid instance that a clip has moved.
struct MovedInstance
{
    uint32_t instance = 0;
    Affine3 world_from_object;
};

/// An instance of a mesh with joints or morph targets.
struct PosedInstance
{
    uint32_t instance = 0;
    std::span<const Affine3d> world_from_bind; ///< for each joint of the skin; without a skin of the node
    std::span<const float> morph_weights;      ///< for each morph target of the mesh
};

/// For one pack, which has been checked and outlives it. Starts at rest. Allocates only when it is made.
class PosePlayer
{
public:
    explicit PosePlayer(const formats::PackView& pack);

    void rest();
    void play(ClipTime clip);
    /// weight  0: `from`, 1: `to`
    void blend(ClipTime from, ClipTime to, double weight);

    /// Rigid instances that now stand elsewhere than before the last call of the three above. Valid until the next.
    std::span<const MovedInstance> moved() const { return {moved_.data(), moved_count_}; }

    /// All rigid instances that clips move, and where they stand now.
    std::span<const MovedInstance> places() const { return places_; }

    /// All deformed instances, ascending. Valid until the next call of the three.
    std::span<const PosedInstance> posed() const { return posed_; }

private:
    struct Rigid
    {
        uint32_t node;
        Affine3d node_from_object;
    };
    struct Deformed
    {
        uint32_t instance;
        uint32_t skin; ///< or none
        uint32_t node;
        Affine3d node_from_object;
        formats::Range morph_weights; ///< of the pose
        size_t first_joint;           ///< of palettes_
        uint32_t joint_count;
        size_t first_weight; ///< of weights_
        uint32_t target_count;
    };
    Affine3d nodeFromObject(const formats::InstanceRecord& instance) const;
    void addRigid(uint32_t instance);
    void addDeformed(uint32_t instance, const formats::DeformedMeshRecord& mesh, uint32_t targets);
    void resetTo(formats::ScenePose& pose) const;
    void take(const formats::ScenePose& pose);
    void placeRigid(size_t rigid);
    void poseDeformed(const Deformed& deformed, const formats::ScenePose& pose);

    formats::MotionTables tables_;
    std::span<const formats::InstanceRecord> instances_;
    formats::ScenePose rest_, from_, to_;
    std::vector<uint32_t> parents_first_;
    std::vector<Affine3d> world_from_node_;
    std::vector<Rigid> rigid_;
    std::vector<Deformed> deformed_;
    std::vector<Affine3d> palettes_;
    std::vector<float> weights_;
    std::vector<MovedInstance> places_; ///< of rigid_
    std::vector<MovedInstance> moved_;
    size_t moved_count_ = 0;
    std::vector<PosedInstance> posed_;
};

/// What the chunk DMSH says of a mesh; null where it is rigid.
const formats::DeformedMeshRecord* findDeformedMesh(const formats::PackView& pack, uint32_t mesh);

/// The clip of this name, or else of this number. Nothing where there is none.
std::optional<uint32_t> findAnimation(const formats::PackView& pack, std::string_view name);

} // namespace hearth::pack
