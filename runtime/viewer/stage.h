// Parts of a scene looked at one by one: each where it stands, framed, and all else out of the way.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"
#include "runtime/frame/frame.h"
#include "runtime/gpu/scene/instance_motion.h"
#include "runtime/pack/pose_player.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace hearth::viewer
{

class Stage
{
public:
    /// Shows each mesh by its first instance.
    /// errors: usage, where the pack has no such mesh, or nothing that draws it.
    static Result<Stage> ofMeshes(const formats::PackView& pack, const pack::PosePlayer& player,
                                  std::span<const uint32_t> meshes, float aspect);

    /// Shows each of these ranges of instances, as those of an asset.
    static Stage ofInstances(const formats::PackView& pack, const pack::PosePlayer& player,
                             std::span<const formats::Range> parts, float aspect);

    /// One for each part.
    const std::vector<shared::Camera>& cameras() const { return cameras_; }

    /// The scene was loaded anew: all instances stand in their places.
    void reset() { std::fill(away_.begin(), away_.end(), uint8_t{0}); }

    /// Returns what the scene's next frame must be told to show part `number` alone, and the part of the call before no more;
    /// of rigid instances.
    /// clip_moves  of a clip that plays: they hold for what is shown
    /// errors: those of gpu::moveInstance.
    Result<std::vector<gpu::InstanceMove>> show(const gpu::Scene& scene, size_t number,
                                                std::span<const gpu::InstanceMove> clip_moves = {});

    /// The poses of deformed instances, with all but those of that part out of the way. Valid until the next call.
    std::span<const gpu::InstancePose> poses(const pack::PosePlayer& player, size_t number);

private:
    Stage(const formats::PackView& pack, const pack::PosePlayer& player);

    std::vector<formats::Range> parts_; ///< instances of each
    std::vector<shared::Camera> cameras_;
    std::vector<uint8_t> is_deformed_; ///< [instance]
    std::vector<uint8_t> away_;        ///< [instance] moved away by show()
    std::vector<gpu::InstancePose> poses_;
    std::vector<std::vector<Affine3d>> palettes_; ///< of poses_
};

} // namespace hearth::viewer
