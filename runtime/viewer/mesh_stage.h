// Meshes of a scene looked at one by one: each where its first instance stands, framed, and all else out of the way.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack_view.h"
#include "formats/shared/frame.h"
#include "runtime/gpu/instance_motion.h"
#include "runtime/pack/pose_player.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::viewer
{

class MeshStage
{
public:
    /// errors: usage, where the pack has no such mesh, or nothing that draws it.
    static Result<MeshStage> create(const formats::PackView& pack, const pack::PosePlayer& player,
                                    std::span<const uint32_t> meshes, float aspect);

    /// One for each mesh.
    const std::vector<shared::Camera>& cameras() const { return cameras_; }

    /// What the scene's next frame must be told to show mesh `number` of the list alone, and the mesh of the call before no
    /// more; of rigid instances. errors: those of gpu::moveInstance.
    Result<std::vector<gpu::InstanceMove>> show(const gpu::Scene& scene, size_t number);

    /// The poses of deformed instances, with all but those of that mesh out of the way. Valid until the next call.
    std::span<const gpu::InstancePose> poses(const pack::PosePlayer& player, size_t number);

private:
    std::vector<uint32_t> instance_of_mesh_; ///< of the list
    std::vector<shared::Camera> cameras_;
    std::vector<uint8_t> is_deformed_; ///< [instance]
    std::vector<uint8_t> away_;        ///< [instance] moved away by show()
    std::vector<gpu::InstancePose> poses_;
    std::vector<std::vector<Affine3d>> palettes_; ///< of poses_
};

} // namespace hearth::viewer
