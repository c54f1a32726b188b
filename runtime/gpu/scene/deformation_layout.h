// How the poses of a scene's deformed instances are arranged for the device, and what a new pose changes there. Plain
// data, no Vulkan. formats/gpu_shared/deformation.h has the records; runtime/gpu/README.md, "Characters".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/affine3d.h"
#include "formats/gpu_shared/deformation.h"
#include "formats/pack/pack_view.h"
#include "runtime/frame/frame.h"

#include <optional>
#include <span>
#include <vector>

namespace hearth::gpu
{

/// A pose of a deformed instance, as pack::PosePlayer gives them, or of the caller's making.
struct InstancePose
{
    uint32_t instance = 0;
    std::span<const Affine3d> world_from_bind{}; ///< for each joint of its mesh's skin; one without a skin
    std::span<const float> morph_weights{};      ///< for each morph target of its mesh

    /// Not of the clips, nor between two of them (ragdoll, inverse kinematics; morph weights outside of 0 to 1): culled
    /// by where the joints are, which is always right and finds less.
    bool free = false;
};

/// An instance of a mesh that the chunk DMSH describes, and where its pose lies.
struct DeformedInstance
{
    uint32_t instance = 0;
    uint32_t anchor = 0; ///< joint of the skin
    uint32_t joint_count = 0;
    uint32_t target_count = 0; ///< morph targets
    uint32_t pose_row = 0; ///< of the buffer: the Pose, behind it the palette, behind that the morph weights
    uint32_t row_count = 0;
    uint32_t cluster_row = 0;  ///< as shared::Pose
    shared::Instance record{}; ///< but for its transform; `mesh` is a row of its own in the table of bounds
    Box3 box_in_clips;         ///< where the anchor carries it
    Box3 box_in_bind;
};

/// What a pose is on the device.
struct PosedRows
{
    shared::Instance record{};
    shared::MeshBounds bounds{};
    std::vector<uint32_t> words; ///< of row_count rows, from pose_row
};

struct DeformationLayout
{
    std::vector<DeformedInstance> instances; ///< ascending by instance
    std::vector<uint32_t> words;             ///< the buffer, but for the scratch; all at rest
    uint32_t block_words = 0;                ///< of the scratch: the most that a cluster's vertices take
    uint64_t instanced_clusters = 0;         ///< that a frame draws at most
    uint32_t most_rows = 0;                  ///< of a pose
};

/// Where a scene has no deformed meshes, nothing. The rows of `bounds` and of `instances` become those of the poses at
/// rest.
///
/// bounds     of the meshes; gets a row for each deformed instance behind them
/// instances  those of the pack
DeformationLayout makeDeformationLayout(const formats::PackView& pack,
                                        std::vector<shared::MeshBounds>& bounds,
                                        std::vector<shared::Instance>& instances);

/// The blocks of scratch behind the words: as many as `bytes` holds, and no more than a frame can use.
void placeScratch(DeformationLayout& layout, uint64_t bytes);

/// False where a number of the pose is not finite or does not fit into floats. Allocates nothing where `rows` has been
/// of this instance, or of one with more rows.
bool poseInstance(const DeformedInstance& instance, const InstancePose& pose, PosedRows& rows);

/// Of a free pose: from the origin of the instance, in metres; it holds all of it. Else nothing.
std::optional<Sphere> freeSphere(const PosedRows& rows);

/// The poses of all deformed instances at rest, which the layout's words hold; in the order of the instances.
std::vector<PosedRows> posesAtRest(const formats::PackView& pack, const DeformationLayout& layout);

/// Of the instance with this number; null where it is rigid.
const DeformedInstance* findDeformed(const DeformationLayout& layout, uint32_t instance);

} // namespace hearth::gpu
