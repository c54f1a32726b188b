// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/scene/scene_deformation.h"

#include "runtime/gpu/scene/scene.h"
#include "runtime/gpu/scene/scene_shadows.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace hearth::gpu
{

namespace
{

bool isFinite(const InstancePose& pose)
{
    return std::all_of(pose.world_from_bind.begin(), pose.world_from_bind.end(),
                       [](const Affine3d& joint) { return narrowed(joint).has_value(); }) &&
           std::all_of(pose.morph_weights.begin(), pose.morph_weights.end(),
                       [](float weight) { return std::isfinite(weight); });
}

bool fits(const DeformedInstance& instance, const InstancePose& pose)
{
    return pose.world_from_bind.size() == instance.joint_count &&
           pose.morph_weights.size() == instance.target_count;
}

} // namespace

Status checkPose(const Scene& scene, const InstancePose& pose)
{
    const auto fail = [&](const std::string& detail) {
        return Error{Issue::usage, "", "instance " + std::to_string(pose.instance), detail};
    };
    const DeformedInstance* instance =
        scene.deformation == nullptr ? nullptr : findDeformed(scene.deformation->layout, pose.instance);
    if (instance == nullptr)
        return fail("it has no joints or morph targets that a pose could move");
    if (!fits(*instance, pose))
        return fail("its pose has " + std::to_string(pose.world_from_bind.size()) + " joints and " +
                    std::to_string(pose.morph_weights.size()) + " morph weights, its mesh " +
                    std::to_string(instance->joint_count) + " and " + std::to_string(instance->target_count));
    if (!isFinite(pose))
        return fail("its pose has numbers that are not finite or do not fit into single precision");
    return success();
}

void takePoses(const Scene& scene, std::span<const InstancePose> poses)
{
    if (scene.deformation == nullptr)
        return;
    SceneDeformation& deformation = *scene.deformation;
    for (const InstancePose& pose : poses)
    {
        const DeformedInstance* instance = findDeformed(deformation.layout, pose.instance);
        PoseRows& rows = deformation.rows;
        if (instance == nullptr || !fits(*instance, pose) || !poseInstance(*instance, pose, rows))
            continue;
        scene.tables->instances.writeRow(pose.instance, rows.record);
        scene.tables->bounds.writeRow(rows.record.mesh, rows.bounds);
        deformation.table.write(instance->pose_row * VkDeviceSize{16}, std::as_bytes(std::span(rows.words)));
        if (scene.shadows != nullptr)
            scene.shadows->pose(*instance, rows);
    }
}

} // namespace hearth::gpu
