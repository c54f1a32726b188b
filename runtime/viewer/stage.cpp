// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/stage.h"

#include "runtime/pack/scene_boxes.h"
#include "runtime/viewer/camera_fit.h"

namespace hearth::viewer
{

namespace
{

// Distance by which hidden parts move up. Cameras of fitCamera look down, so they are behind the camera.
constexpr float kHideOffset = 1e9f; // metres

bool isIn(const formats::Range& part, uint32_t instance)
{
    return instance >= part.first && instance - part.first < part.count;
}

} // namespace

Stage::Stage(const formats::PackView& pack, const pack::PosePlayer& player)
    : is_deformed_(pack.instances().size(), 0), hidden_(pack.instances().size(), 0)
{
    for (const pack::PosedInstance& posed : player.posed())
        is_deformed_[posed.instance] = 1;
}

Result<Stage> Stage::fromMeshes(const formats::PackView& pack, const pack::PosePlayer& player,
                                std::span<const uint32_t> meshes, float aspect)
{
    const std::span<const formats::InstanceRecord> instances = pack.instances();
    Stage stage(pack, player);
    for (const uint32_t mesh : meshes)
    {
        const auto found =
            std::find_if(instances.begin(), instances.end(),
                         [&](const formats::InstanceRecord& instance) { return instance.mesh == mesh; });
        if (found == instances.end() || pack.meshes()[mesh].clusters.count == 0)
            return Error{Issue::usage, pack.name(), "",
                         "--meshes: nothing draws a mesh " + std::to_string(mesh)};
        const formats::Range part{static_cast<uint32_t>(found - instances.begin()), 1};
        stage.parts_.push_back(part);
        stage.cameras_.push_back(fitCamera(pack::instanceBoxes(pack, player, part), aspect));
    }
    return stage;
}

Stage Stage::fromInstances(const formats::PackView& pack, const pack::PosePlayer& player,
                           std::span<const formats::Range> parts, float aspect)
{
    Stage stage(pack, player);
    for (const formats::Range part : parts)
    {
        stage.parts_.push_back(part);
        stage.cameras_.push_back(fitCamera(pack, player, part, aspect));
    }
    return stage;
}

Result<std::vector<gpu::InstanceMove>> Stage::show(const gpu::Scene& scene, size_t number,
                                                   std::span<const gpu::InstanceMove> clip_moves)
{
    std::vector<gpu::InstanceMove> moves;
    std::vector<uint8_t> has_moved(hidden_.size(), 0);
    for (const gpu::InstanceMove& move : clip_moves)
        if (isIn(parts_[number], move.instance))
        {
            moves.push_back(move);
            has_moved[move.instance] = 1;
        }
    for (uint32_t i = 0; i < hidden_.size(); ++i)
    {
        const bool is_hidden = !isIn(parts_[number], i);
        if (is_deformed_[i] != 0 || (hidden_[i] != 0) == is_hidden)
            continue;
        hidden_[i] = is_hidden ? 1 : 0;
        if (has_moved[i] != 0)
            continue;
        Affine3 place = scene.instances[i].world_from_object;
        if (is_hidden)
            place.m[1][3] += kHideOffset;
        HEARTH_ASSIGN_OR_RETURN(const gpu::InstanceMove move, gpu::moveInstance(scene, i, place));
        moves.push_back(move);
    }
    return moves;
}

std::span<const gpu::InstancePose> Stage::poses(const pack::PosePlayer& player, size_t number)
{
    poses_.clear();
    palettes_.resize(player.posed().size());
    for (const pack::PosedInstance& posed : player.posed())
    {
        const bool is_hidden = !isIn(parts_[number], posed.instance);
        std::vector<Affine3d>& palette = palettes_[poses_.size()];
        palette.assign(posed.world_from_bind.begin(), posed.world_from_bind.end());
        for (Affine3d& joint : palette)
            joint.m[1][3] += is_hidden ? double{kHideOffset} : 0;
        poses_.push_back({.instance = posed.instance,
                          .world_from_bind = palette,
                          .morph_weights = posed.morph_weights,
                          .free = is_hidden}); // no clip goes there
    }
    return poses_;
}

} // namespace hearth::viewer
