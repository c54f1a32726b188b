// Plays the animation clips of a pack: transforms of rigid instances, and joint palettes of deformed ones.
// One clip or a blend of two, for the whole scene; formats/scene/animation.h defines poses. Independent of
// Vulkan.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"
#include "formats/scene/animation.h"

#include <optional>
#include <span>
#include <vector>

namespace hearth::pack
{

/// Time in a clip. Before its first and after its last key the pose is constant; a caller that wants a loop
/// wraps the time.
struct ClipTime
{
    uint32_t animation = 0; ///< index in the pack
    double seconds = 0;
};

/// Clips that make a pose; without any the scene is at rest.
struct PlayedClips
{
    std::optional<ClipTime> from{};
    std::optional<ClipTime> to{}; ///< blended with `from`
    double weight = 0;            ///< 0: `from`, 1: `to`
};

/// Transform of a rigid instance that a clip has moved.
struct MovedInstance
{
    uint32_t instance = 0;
    Affine3 world_from_object;
};

/// Instance of a mesh with joints or morph targets, in its pose.
struct PosedInstance
{
    uint32_t instance = 0;
    /// for each joint of the skin; without a skin, one transform of the node
    std::span<const Affine3d> world_from_bind;
    std::span<const float> morph_weights; ///< for each morph target of the mesh
};

/// Animation player for one checked pack, which must outlive it. Starts in the rest pose. Only the
/// constructor allocates.
class PosePlayer
{
public:
    explicit PosePlayer(const formats::PackView& pack);

    void rest();
    void play(ClipTime clip);
    /// weight  0: `from`, 1: `to`
    void blend(ClipTime from, ClipTime to, double weight);

    /// Return the arguments of the last call of rest, play or blend.
    const PlayedClips& clips() const { return clips_; }

    /// Return the world transform of each node in the pose.
    std::span<const Affine3d> worldFromNode() const { return world_from_node_; }

    /// Return the rigid instances whose transform changed in the last call of rest, play or blend. Valid
    /// until the next such call.
    std::span<const MovedInstance> moved() const { return {moved_.data(), moved_count_}; }

    /// Return all rigid instances that clips move, with their current transforms.
    std::span<const MovedInstance> transforms() const { return placed_; }

    /// Return all deformed instances, ascending. Valid until the next call of rest, play or blend.
    std::span<const PosedInstance> posed() const { return posed_; }

private:
    struct RigidInstance
    {
        uint32_t node;
        Affine3d node_from_object;
    };
    struct DeformedInstance
    {
        uint32_t instance;
        uint32_t skin; ///< index, or none
        uint32_t node;
        Affine3d node_from_object;
        formats::Range morph_weights; ///< range in the weights of the pose
        size_t first_joint;           ///< index in palettes_
        uint32_t joint_count;
        size_t first_weight; ///< index in weights_
        uint32_t target_count;
    };
    void addRigid(uint32_t instance);
    void addDeformed(uint32_t instance, const formats::DeformedMeshRecord& mesh, uint32_t targets);
    void resetTo(formats::ScenePose& pose) const;
    void apply(const formats::ScenePose& pose);
    void placeRigid(size_t rigid);
    void poseDeformed(const DeformedInstance& deformed, const formats::ScenePose& pose);

    formats::AnimationTables tables_;
    std::span<const formats::InstanceRecord> instances_;
    formats::ScenePose rest_, from_, to_;
    std::vector<uint32_t> parents_first_;
    PlayedClips clips_;
    std::vector<Affine3d> world_from_node_;
    std::vector<RigidInstance> rigid_;
    std::vector<DeformedInstance> deformed_;
    std::vector<Affine3d> palettes_;
    std::vector<float> weights_;
    std::vector<MovedInstance> placed_; ///< [rigid_.size()]
    std::vector<MovedInstance> moved_;
    size_t moved_count_ = 0;
    std::vector<PosedInstance> posed_;
};

/// Find the record of the chunk DMSH for a mesh; null where the mesh is rigid.
const formats::DeformedMeshRecord* findDeformedMesh(const formats::PackView& pack, uint32_t mesh);

/// Find a clip by name, else by index; nullopt where there is none.
std::optional<uint32_t> findAnimation(const formats::PackView& pack, std::string_view name);

} // namespace hearth::pack
