// Device layout of the poses of a scene's deformed instances, and the words that a new pose writes. Plain
// data, no Vulkan. formats/gpu_shared/deformation.h has the records; see runtime/gpu/README.md, "Characters".
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

/// Pose of a deformed instance, from pack::PosePlayer or from the caller.
struct InstancePose
{
    uint32_t instance = 0;
    std::span<const Affine3d> world_from_bind{}; ///< one per joint of the mesh's skin; one without a skin
    std::span<const float> morph_weights{};      ///< one per morph target of the mesh

    /// Not a pose of the clips, nor a blend of two (ragdoll, inverse kinematics, morph weights outside of 0
    /// to 1). Culled by joint positions: always correct, but culls less.
    bool free = false;
};

/// Instance of a mesh that the chunk DMSH describes, and the place of its pose in the buffer.
struct DeformedInstance
{
    uint32_t instance = 0;
    uint32_t anchor = 0; ///< joint of the skin
    uint32_t joint_count = 0;
    uint32_t target_count = 0; ///< morph targets
    uint32_t pose_row = 0;     ///< row of the Pose in the buffer; then the palette, then the morph weights
    uint32_t row_count = 0;
    uint32_t cluster_row = 0;  ///< as shared::Pose
    shared::Instance record{}; ///< all but the transform; `mesh` is a row of its own in the table of bounds
    Box3 clip_bounds;          ///< bounds over all clips, in the space of the anchor
    Box3 bind_bounds;
};

/// Device data of a pose.
struct PoseRows
{
    shared::Instance record{};
    shared::MeshBounds bounds{};
    std::vector<uint32_t> words; ///< row_count rows, from pose_row
};

struct DeformationLayout
{
    std::vector<DeformedInstance> instances; ///< ascending by instance
    std::vector<uint32_t> words;             ///< the buffer without the scratch; all instances at rest
    uint32_t block_words = 0; ///< words of a scratch block: the most that the vertices of one cluster take
    uint64_t instanced_clusters = 0; ///< largest number of deformed clusters of a frame
    uint32_t max_rows = 0;           ///< largest number of rows of a pose
};

/// Compute the layout; empty if the scene has no deformed meshes. Changes the rows of `bounds` and
/// `instances` to the poses at rest.
///
/// bounds     bounds of the meshes; a row for each deformed instance is appended
/// instances  instances of the pack
DeformationLayout makeDeformationLayout(const formats::PackView& pack,
                                        std::vector<shared::MeshBounds>& bounds,
                                        std::vector<shared::Instance>& instances);

/// Place the scratch blocks: as many as `bytes` holds, and no more than a frame can use.
/// first_word  of the buffer; behind the words
void placeScratch(DeformationLayout& layout, uint32_t first_word, uint64_t bytes);

/// Compute the device data of a pose. False if a number is not finite or does not fit into floats. Allocates
/// nothing if `rows` was used for this instance before, or for one with at least as many rows.
bool poseInstance(const DeformedInstance& instance, const InstancePose& pose, PoseRows& rows);

/// Bounding sphere of a free pose, relative to the origin of the instance, in metres; none for other poses.
std::optional<Sphere> freeSphere(const PoseRows& rows);

/// Return the poses of all deformed instances at rest, as in the words of the layout, in the order of the
/// instances.
std::vector<PoseRows> makeRestPoses(const formats::PackView& pack, const DeformationLayout& layout);

/// Return the deformed instance with this index; null if the instance is rigid.
const DeformedInstance* findDeformed(const DeformationLayout& layout, uint32_t instance);

} // namespace hearth::gpu
