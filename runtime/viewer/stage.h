// Stage: shows parts of a scene one by one, each at its place with a fitted camera, all else moved away.
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
    /// Show each mesh by its first instance. errors: usage if the pack has no such mesh, or no instance of
    /// it.
    static Result<Stage> fromMeshes(const formats::PackView& pack, const pack::PosePlayer& player,
                                    std::span<const uint32_t> meshes, float aspect);

    /// Show each of these ranges of instances, such as the instances of an asset.
    static Stage fromInstances(const formats::PackView& pack, const pack::PosePlayer& player,
                               std::span<const formats::Range> parts, float aspect);

    /// Cameras, one per part.
    const std::vector<shared::Camera>& cameras() const { return cameras_; }

    /// Reset after the scene was reloaded: all instances are in their places.
    void reset() { std::fill(hidden_.begin(), hidden_.end(), uint8_t{0}); }

    /// Return the moves with which the scene's next frame shows part `number` alone and hides the part of the
    /// last call; rigid instances only.
    /// clip_moves  moves of a playing clip: applied to the shown part
    /// errors: same as gpu::moveInstance.
    Result<std::vector<gpu::InstanceMove>> show(const gpu::Scene& scene, size_t number,
                                                std::span<const gpu::InstanceMove> clip_moves = {});

    /// Return the poses of deformed instances, with all parts but that one moved away. Valid until the next
    /// call.
    std::span<const gpu::InstancePose> poses(const pack::PosePlayer& player, size_t number);

private:
    Stage(const formats::PackView& pack, const pack::PosePlayer& player);

    std::vector<formats::Range> parts_; ///< instances of each part
    std::vector<shared::Camera> cameras_;
    std::vector<uint8_t> is_deformed_; ///< [instance]
    std::vector<uint8_t> hidden_;      ///< [instance] moved away by show()
    std::vector<gpu::InstancePose> poses_;
    std::vector<std::vector<Affine3d>> palettes_; ///< of poses_
};

} // namespace hearth::viewer
