// Culls clusters of deformed (skinned or morphed) meshes in a pose; one source for C++ and GLSL, as
// decisions.h. Defines the pose buffer of a scene: rows of four words in one buffer, the last slice of the
// geometry pool.
//
//     header | a word for each instance | poses | clusters | joints of clusters | palettes | morph weights |
//     scratch
//
// An instance's palette is relative to the instance's origin (the translation of its row in the table of
// instances), so a character far from the world's origin keeps its precision. See runtime/gpu/README.md.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_DEFORMATION_H
#define HEARTH_SHARED_DEFORMATION_H

#include "formats/gpu_shared/occlusion.h"

HEARTH_SHARED_BEGIN

/// Slice of the geometry pool that holds the poses, in scenes with deformed meshes.
HEARTH_CONSTANT uint kDeformationSlice = 3;

/// Header at the start of the buffer. Slots are slots of the visible list.
struct DeformationHeader
{
    /// First word of a table with the row of each instance's Pose; 0: the instance is rigid
    uint instance_word;
    /// First word of the skinned vertices: block i belongs to the i-th deformed cluster of the frame
    uint scratch_word;
    uint block_words;
    uint block_count;
    uint early_first; ///< slots of deformed clusters of the first phase: [early_first, early_end)
    uint early_end;
    uint late_first; ///< the same for the second phase
    uint late_end;
    uint groups_x; ///< VkDispatchIndirectCommand of the skinning pass
    uint groups_y;
    uint groups_z;
    uint group_count; ///< number of clusters of the last phase that are skinned into the scratch
};

/// Return the number of deformed clusters in a frame's visible list, of both phases.
HEARTH_FUNCTION uint deformedSlots(HEARTH_IN(DeformationHeader) header)
{
    return (header.early_end - header.early_first) + (header.late_end - header.late_first);
}

/// Pose of an instance.
struct Pose
{
    uint palette_row;
    uint morph_word;  ///< weights of the morph targets
    uint cluster_row; ///< row of cluster 0 of the pack, as if it belonged to this mesh; may wrap around
    uint flags;       ///< bits kPose*
    /// Bounding sphere of the whole instance in a free pose: centre, from the instance's origin.
    Float3 free_bounds_center;
    float free_bounds_radius; ///< in units of the instance's scale_max
    /// Factor of bind boxes around their middles: the largest absolute morph weight, at least 1
    float free_box_scale;
    uint unused_x;
    uint unused_y;
    uint unused_z;
};

/// Bit of Pose::flags: the pose is neither a key of a clip nor between two keys, so the bounds of clips do
/// not apply.
HEARTH_CONSTANT uint kPoseFree = 1;

/// Transformation of one joint.
struct PaletteRow
{
    Float4 world_from_bind_x; ///< w: translation from the instance's origin
    Float4 world_from_bind_y;
    Float4 world_from_bind_z;
    /// Inverse of the linear part; w of this row is 0 where normal cones cannot be tested
    Float4 bind_from_world_x;
    Float4 bind_from_world_y;
    Float4 bind_from_world_z;
};

/// Culling data of a deformed cluster, from the chunks CLUS and DCLU.
struct DeformedCluster
{
    Float3 box_min; ///< bounding box over all poses of the clips, in the cluster's frame
    uint joint;
    Float3 box_max;
    uint cone;       ///< as Cluster::cone
    Float3 bind_min; ///< bounding box in the bind pose, with morph weights from -1 to 1
    float cone_back;
    Float3 bind_max;
    uint first_joint; ///< first word of its joints
    uint group;
    uint refined_group;
    uint joint_count;
    uint triangle_count;
};

/// Sizes in rows of the buffer.
HEARTH_CONSTANT uint kPaletteRows = 6;
HEARTH_CONSTANT uint kDeformedClusterRows = 5;
HEARTH_CONSTANT uint kPoseRows = 3;

/// Half the side of a box that contains everything.
HEARTH_CONSTANT float kUnbounded = 1e15f;

/// Return the view relative to the instance's origin, as the instance's palette is.
HEARTH_FUNCTION FrameView viewFromOrigin(HEARTH_IN(FrameView) view, HEARTH_IN(Instance) instance)
{
    FrameView moved = view;
    HEARTH_PRECISE Float3 eye =
        Float3(view.eye.x - instance.world_from_object_x.w, view.eye.y - instance.world_from_object_y.w,
               view.eye.z - instance.world_from_object_z.w);
    moved.eye = eye;
    return moved;
}

HEARTH_FUNCTION OcclusionView occlusionFromOrigin(HEARTH_IN(OcclusionView) view, HEARTH_IN(Instance) instance)
{
    OcclusionView moved = view;
    HEARTH_PRECISE Float3 eye =
        Float3(view.eye.x - instance.world_from_object_x.w, view.eye.y - instance.world_from_object_y.w,
               view.eye.z - instance.world_from_object_z.w);
    moved.eye = eye;
    return moved;
}

/// Transformed bounding box of a cluster, from the instance's origin.
struct TransformedBox
{
    Instance joint_instance;
    Float3 box_min;
    Float3 box_max;
};

HEARTH_FUNCTION Instance instanceOfJoint(HEARTH_IN(Instance) instance, HEARTH_IN(PaletteRow) joint)
{
    Instance joint_instance = instance;
    joint_instance.world_from_object_x = joint.world_from_bind_x;
    joint_instance.world_from_object_y = joint.world_from_bind_y;
    joint_instance.world_from_object_z = joint.world_from_bind_z;
    return joint_instance;
}

/// Return the box of a cluster in a pose of the clips, in the space of its main bone alone. Call shareFrame
/// for the other joints of its frame.
/// joint  palette row of the cluster's joint
HEARTH_FUNCTION TransformedBox boxInClips(HEARTH_IN(Instance) instance, HEARTH_IN(PaletteRow) joint,
                                          HEARTH_IN(DeformedCluster) cluster)
{
    TransformedBox box;
    box.joint_instance = instanceOfJoint(instance, joint);
    box.box_min = cluster.box_min;
    box.box_max = cluster.box_max;
    return box;
}

/// Return the joint of a word of a cluster's list.
HEARTH_FUNCTION uint listedJoint(uint word)
{
    return word & 0xffffu;
}

/// Return the share of a joint in the cluster's frame, from 0 to 1. Joints with a share come first in the
/// list, behind the main bone, whose word has none.
HEARTH_FUNCTION float frameShare(uint word)
{
    return float(word >> 16u) * (1.0f / 65536.0f);
}

/// Return a row of a matrix, moved by a share of the way from one matrix to another.
HEARTH_FUNCTION Float4 movedRow(HEARTH_IN(Float4) row, HEARTH_IN(Float4) from, HEARTH_IN(Float4) to,
                                float share)
{
    HEARTH_PRECISE float x = row.x + (to.x - from.x) * share;
    HEARTH_PRECISE float y = row.y + (to.y - from.y) * share;
    HEARTH_PRECISE float z = row.z + (to.z - from.z) * share;
    HEARTH_PRECISE float w = row.w + (to.w - from.w) * share;
    return Float4(x, y, z, w);
}

/// Give a joint its share of the frame that a box is in: the main bone's gets smaller. Call it for all joints
/// with a share, in the order of the list.
HEARTH_FUNCTION TransformedBox shareFrame(HEARTH_IN(TransformedBox) box, HEARTH_IN(PaletteRow) main_joint,
                                          HEARTH_IN(PaletteRow) joint, float share)
{
    TransformedBox shared_box = box;
    shared_box.joint_instance.world_from_object_x = movedRow(
        box.joint_instance.world_from_object_x, main_joint.world_from_bind_x, joint.world_from_bind_x, share);
    shared_box.joint_instance.world_from_object_y = movedRow(
        box.joint_instance.world_from_object_y, main_joint.world_from_bind_y, joint.world_from_bind_y, share);
    shared_box.joint_instance.world_from_object_z = movedRow(
        box.joint_instance.world_from_object_z, main_joint.world_from_bind_z, joint.world_from_bind_z, share);
    return shared_box;
}

/// Return an empty box for a free pose. Call growByJoint for each joint that moves the cluster.
HEARTH_FUNCTION TransformedBox makeEmptyFreeBox(HEARTH_IN(Instance) instance)
{
    TransformedBox box;
    box.joint_instance = instance;
    box.joint_instance.world_from_object_x = Float4(1.0f, 0.0f, 0.0f, 0.0f);
    box.joint_instance.world_from_object_y = Float4(0.0f, 1.0f, 0.0f, 0.0f);
    box.joint_instance.world_from_object_z = Float4(0.0f, 0.0f, 1.0f, 0.0f);
    box.box_min = Float3(kUnbounded, kUnbounded, kUnbounded);
    box.box_max = Float3(-kUnbounded, -kUnbounded, -kUnbounded);
    return box;
}

/// Grow a box by the bind box as one joint transforms it. A skinned vertex is a convex combination of its
/// positions under each single joint, so the union of the boxes contains the cluster whatever the weights.
/// Morph targets enlarge the bind box beyond the vertices by at most half of its size, so the box scaled by a
/// weight contains that weight's displacement.
HEARTH_FUNCTION TransformedBox growByJoint(HEARTH_IN(TransformedBox) box, HEARTH_IN(PaletteRow) joint,
                                           Float3 bind_min, Float3 bind_max, float stretch)
{
    HEARTH_PRECISE Float3 center = (bind_min + bind_max) * 0.5f;
    HEARTH_PRECISE Float3 half_size = (bind_max - bind_min) * (0.5f * stretch);
    Float3 row_x = row3(joint.world_from_bind_x);
    Float3 row_y = row3(joint.world_from_bind_y);
    Float3 row_z = row3(joint.world_from_bind_z);
    HEARTH_PRECISE Float3 at = Float3(dot3(row_x, center) + joint.world_from_bind_x.w,
                                      dot3(row_y, center) + joint.world_from_bind_y.w,
                                      dot3(row_z, center) + joint.world_from_bind_z.w);
    // magnitude of the terms that rounding errors are relative to
    HEARTH_PRECISE Float3 reach = abs3(center) + half_size;
    HEARTH_PRECISE Float3 magnitude = Float3(dot3(abs3(row_x), reach) + abs(joint.world_from_bind_x.w),
                                             dot3(abs3(row_y), reach) + abs(joint.world_from_bind_y.w),
                                             dot3(abs3(row_z), reach) + abs(joint.world_from_bind_z.w));
    HEARTH_PRECISE Float3 extent =
        Float3(dot3(abs3(row_x), half_size), dot3(abs3(row_y), half_size), dot3(abs3(row_z), half_size)) +
        magnitude * kRoundingSlack;
    HEARTH_PRECISE Float3 low = at - extent;
    HEARTH_PRECISE Float3 high = at + extent;
    TransformedBox grown = box;
    grown.box_min = Float3(min(box.box_min.x, low.x), min(box.box_min.y, low.y), min(box.box_min.z, low.z));
    grown.box_max =
        Float3(max(box.box_max.x, high.x), max(box.box_max.y, high.y), max(box.box_max.z, high.z));
    return grown;
}

/// Return the group as the cut tests it. In a free pose the cooked spheres are invalid: all groups get the
/// bounding sphere of the instance, and only their errors differ.
HEARTH_FUNCTION Group groupInPose(HEARTH_IN(Group) group, HEARTH_IN(Pose) pose)
{
    Group placed = group;
    if ((pose.flags & kPoseFree) != 0u)
    {
        placed.sphere_center = pose.free_bounds_center;
        placed.sphere_radius = pose.free_bounds_radius;
    }
    return placed;
}

/// Apply the cut rule in any pose. `refined` is the cluster's refined group, or its own group if it has none.
HEARTH_FUNCTION bool deformedInCut(HEARTH_IN(FrameView) view, HEARTH_IN(Instance) instance,
                                   HEARTH_IN(Pose) pose, HEARTH_IN(DeformedCluster) cluster,
                                   HEARTH_IN(Group) own, HEARTH_IN(Group) refined)
{
    return clusterInCut(view, instance, groupInPose(own, pose), cluster.refined_group != kNoGroup,
                        groupInPose(refined, pose));
}

/// True if the cluster passes the frustum test.
HEARTH_FUNCTION bool deformedInFrustum(HEARTH_IN(FrameView) view, HEARTH_IN(Instance) instance,
                                       HEARTH_IN(TransformedBox) box)
{
    return (view.flags & kCullFrustum) == 0u ||
           !boxOutsideFrustum(viewFromOrigin(view, instance), box.joint_instance, box.box_min, box.box_max);
}

/// Find the reach of a deformed cluster, by the box that the frustum test uses. Clusters of deformed meshes
/// are small, so the box along the axes of the world is little larger.
HEARTH_FUNCTION TexelReach deformedReach(HEARTH_IN(FrameView) view, HEARTH_IN(Instance) instance,
                                         HEARTH_IN(TransformedBox) box)
{
    return boxReach(viewFromOrigin(view, instance), box.joint_instance, box.box_min, box.box_max);
}

/// True if every triangle faces away, in a pose of the clips.
/// joint  palette row of the cluster's joint
HEARTH_FUNCTION bool deformedFacesAway(HEARTH_IN(FrameView) view, HEARTH_IN(Instance) instance,
                                       HEARTH_IN(Pose) pose, HEARTH_IN(PaletteRow) joint,
                                       HEARTH_IN(DeformedCluster) cluster)
{
    if ((view.flags & kCullCone) == 0u || (pose.flags & kPoseFree) != 0u || joint.bind_from_world_x.w == 0.0f)
        return false;
    InstanceInverse inverse;
    inverse.object_from_world_x = joint.bind_from_world_x;
    inverse.object_from_world_y = joint.bind_from_world_y;
    inverse.object_from_world_z = joint.bind_from_world_z;
    FrameView moved = viewFromOrigin(view, instance);
    HEARTH_PRECISE Float3 offset =
        Float3(moved.eye.x - joint.world_from_bind_x.w, moved.eye.y - joint.world_from_bind_y.w,
               moved.eye.z - joint.world_from_bind_z.w);
    return boxFacesAway(view, viewEye(view, inverse, offset), cluster.cone, cluster.cone_back,
                        cluster.box_min, cluster.box_max);
}

HEARTH_SHARED_END

#ifdef __cplusplus
static_assert(sizeof(hearth::shared::DeformationHeader) == 48);
static_assert(sizeof(hearth::shared::Pose) == 16 * hearth::shared::kPoseRows);
static_assert(sizeof(hearth::shared::PaletteRow) == 16 * hearth::shared::kPaletteRows);
static_assert(sizeof(hearth::shared::DeformedCluster) == 16 * hearth::shared::kDeformedClusterRows);
static_assert(hearth::shared::kDeformationSlice == hearth::shared::kPoolSlices - 1);
#endif

#endif
