// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/mesh_stage.h"

#include "runtime/gpu/scene_boxes.h"
#include "runtime/viewer/camera_fit.h"

#include <algorithm>

namespace hearth::viewer
{

namespace
{

// Cameras of fitCamera look down: what is high above lies behind them.
constexpr float kAway = 1e9f; // metres

} // namespace

Result<MeshStage> MeshStage::create(const formats::PackView& pack, const pack::PosePlayer& player,
                                    std::span<const uint32_t> meshes, float aspect)
{
    const std::span<const formats::InstanceRecord> instances = pack.instances();
    // as instanceBoxes has them: of instances that have clusters
    const std::vector<gpu::PlacedBox> boxes = gpu::instanceBoxes(pack, player);
    std::vector<const gpu::PlacedBox*> box_of_instance(instances.size(), nullptr);
    size_t next = 0;
    for (size_t i = 0; i < instances.size() && next < boxes.size(); ++i)
        if (pack.meshes()[instances[i].mesh].clusters.count > 0)
            box_of_instance[i] = &boxes[next++];

    MeshStage stage;
    stage.away_.resize(instances.size(), 0);
    stage.is_deformed_.resize(instances.size(), 0);
    for (const pack::PosedInstance& posed : player.posed())
        stage.is_deformed_[posed.instance] = 1;
    for (const uint32_t mesh : meshes)
    {
        const auto found =
            std::find_if(instances.begin(), instances.end(),
                         [&](const formats::InstanceRecord& instance) { return instance.mesh == mesh; });
        const auto instance = static_cast<size_t>(found - instances.begin());
        if (found == instances.end() || box_of_instance[instance] == nullptr)
            return Error{Issue::usage, pack.name(), "",
                         "--meshes: nothing draws a mesh " + std::to_string(mesh)};
        stage.instance_of_mesh_.push_back(static_cast<uint32_t>(instance));
        stage.cameras_.push_back(fitCamera({box_of_instance[instance], 1}, aspect));
    }
    return stage;
}

Result<std::vector<gpu::InstanceMove>> MeshStage::show(const gpu::Scene& scene, size_t number)
{
    std::vector<gpu::InstanceMove> moves;
    for (uint32_t i = 0; i < away_.size(); ++i)
    {
        const bool goes_away = i != instance_of_mesh_[number];
        if (is_deformed_[i] != 0 || (away_[i] != 0) == goes_away)
            continue;
        Affine3 place = scene.instances[i].world_from_object;
        if (goes_away)
            place.m[1][3] += kAway;
        HEARTH_ASSIGN_OR_RETURN(const gpu::InstanceMove move, gpu::moveInstance(scene, i, place));
        moves.push_back(move);
        away_[i] = goes_away ? 1 : 0;
    }
    return moves;
}

std::span<const gpu::InstancePose> MeshStage::poses(const pack::PosePlayer& player, size_t number)
{
    poses_.clear();
    palettes_.resize(player.posed().size());
    for (const pack::PosedInstance& posed : player.posed())
    {
        const bool goes_away = posed.instance != instance_of_mesh_[number];
        std::vector<Affine3d>& palette = palettes_[poses_.size()];
        palette.assign(posed.world_from_bind.begin(), posed.world_from_bind.end());
        for (Affine3d& joint : palette)
            joint.m[1][3] += goes_away ? double{kAway} : 0;
        poses_.push_back({.instance = posed.instance,
                          .world_from_bind = palette,
                          .morph_weights = posed.morph_weights,
                          .free = goes_away}); // no clip goes there
    }
    return poses_;
}

} // namespace hearth::viewer
