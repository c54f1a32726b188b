// Deformed instances of a scene on the device: the poses, which frames update, and the scratch buffer for
// skinned vertices. See runtime/gpu/README.md, "Characters".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/scene/deformation_layout.h"
#include "runtime/gpu/vulkan/mirrored_table.h"

#include <span>

namespace hearth::gpu
{

struct Scene;

struct DeformationOptions
{
    /// Bytes for the vertices of visible deformed clusters, which are skinned once per frame: 36 for a vertex
    /// with a normal and a tangent. Clusters that do not fit are skinned on demand, with the same result.
    uint64_t scratch_bytes = uint64_t{16} << 20;
};

/// Deformation data of a scene that has deformed meshes.
struct SceneDeformation
{
    DeformationLayout layout; ///< without the words, which are in the buffer
    uint32_t first_bin = 0;   ///< first bin of deformed instances; they are the last bins of the scene
    uint32_t rigid_items = 0; ///< first items of the work list
    uint32_t rigid_group_items = 0;
    /// Slice shared::kDeformationSlice of the geometry pool; starts with a shared::DeformationHeader. The
    /// scratch is behind the table.
    MirroredTable table;
    PoseRows rows; ///< of the pose that is being taken
};

/// Check a pose: palette and weights must have the lengths of the instance's mesh and be finite. errors:
/// usage.
Status checkPose(const Scene& scene, const InstancePose& pose);

/// Write poses to the tables. Ignores poses that checkPose rejects: the instance stays as it is.
void takePoses(const Scene& scene, std::span<const InstancePose> poses);

} // namespace hearth::gpu
