// Where clusters of deformed meshes are in a pose, for culling: written once, as decisions.h. And how a scene with such
// meshes keeps its poses on the device: rows of four words in one buffer, the last slice of its geometry pool.
//
//     header | a word for each instance | poses | clusters | joints of clusters | palettes | morph weights | scratch
//
// An instance's palette counts from the instance's origin, the translation of its row in the table of instances, so
// that a character far from the world's origin does not fall apart. RUNTIME 2.5 (design notes).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_DEFORMATION_H
#define HEARTH_SHARED_DEFORMATION_H

#include "formats/gpu_shared/occlusion.h"

HEARTH_SHARED_BEGIN

/// The slice of the geometry pool that holds the poses, in scenes that have any.
HEARTH_CONSTANT uint kDeformationSlice = 3;

/// At the start of the buffer. Slots are those of the visible list.
struct DeformationHeader
{
    uint instance_word; ///< for each instance the row of its Pose; 0: it is rigid
    uint scratch_word;  ///< where the skinned vertices are: block i of the i-th deformed cluster of the frame
    uint block_words;
    uint block_count;
    uint early_first; ///< slots of deformed clusters of the first phase: [early_first, early_end)
    uint early_end;
    uint late_first; ///< of the second
    uint late_end;
    uint groups_x; ///< VkDispatchIndirectCommand of the skinning pass
    uint groups_y;
    uint groups_z;
    uint group_count; ///< clusters of the last phase that are skinned into the scratch
};

/// Deformed clusters of a frame's visible list, of both phases.
HEARTH_FUNCTION uint deformedSlots(HEARTH_IN(DeformationHeader) header)
{
    return (header.early_end - header.early_first) + (header.late_end - header.late_first);
}

/// The pose of an instance.
struct Pose
{
    uint palette_row;
    uint morph_word;  ///< the weight of each morph target
    uint cluster_row; ///< of cluster 0 of the pack, if it were of this mesh; may wrap around
    uint flags;       ///< bits kPose*
    Float3
        free_center;   ///< of a free pose: a sphere that holds the whole instance, from the instance's origin
    float free_radius; ///< times the instance's scale_max
    float free_stretch; ///< of bind boxes around their middles: the largest absolute morph weight, 1 at least
    uint unused_x;
    uint unused_y;
    uint unused_z;
};

/// Of Pose::flags. The pose is not one of the clips or between two of them: bounds of clips say nothing.
HEARTH_CONSTANT uint kPoseFree = 1;

/// How a joint carries what is bound to it.
struct PaletteRow
{
    Float4 world_from_bind_x; ///< w: from the instance's origin
    Float4 world_from_bind_y;
    Float4 world_from_bind_z;
    Float4 bind_from_world_x; ///< inverse of the linear part; its w is 0 where normal cones cannot be tested
    Float4 bind_from_world_y;
    Float4 bind_from_world_z;
};

/// What culling needs to know of a cluster, from the chunks CLUS and DCLU.
struct DeformedCluster
{
    Float3 box_min; ///< where `joint` carries it: all poses of the clips
    uint joint;
    Float3 box_max;
    uint cone;       ///< as Cluster::cone
    Float3 bind_min; ///< bind pose, with morph weights from -1 to 1
    float cone_back;
    Float3 bind_max;
    uint first_joint; ///< word
    uint group;
    uint refined_group;
    uint joint_count;
    uint triangle_count;
};

/// In rows of the buffer.
HEARTH_CONSTANT uint kPaletteRows = 6;
HEARTH_CONSTANT uint kDeformedClusterRows = 5;
HEARTH_CONSTANT uint kPoseRows = 3;

/// Half the side of a box that holds everything.
HEARTH_CONSTANT float kUnbounded = 1e15f;

/// A view from a place that counts from the instance's origin, as its palette does.
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

/// A box that something carries: where a cluster is, from the instance's origin.
struct CarriedBox
{
    Instance carrier;
    Float3 box_min;
    Float3 box_max;
};

HEARTH_FUNCTION Instance carrierOf(HEARTH_IN(Instance) instance, HEARTH_IN(PaletteRow) joint)
{
    Instance carrier = instance;
    carrier.world_from_object_x = joint.world_from_bind_x;
    carrier.world_from_object_y = joint.world_from_bind_y;
    carrier.world_from_object_z = joint.world_from_bind_z;
    return carrier;
}

/// In a pose of the clips. joint  that of the cluster
HEARTH_FUNCTION CarriedBox boxInClips(HEARTH_IN(Instance) instance, HEARTH_IN(PaletteRow) joint,
                                      HEARTH_IN(DeformedCluster) cluster)
{
    CarriedBox box;
    box.carrier = carrierOf(instance, joint);
    box.box_min = cluster.box_min;
    box.box_max = cluster.box_max;
    return box;
}

/// In a free pose: to be grown by each joint that moves the cluster.
HEARTH_FUNCTION CarriedBox emptyFreeBox(HEARTH_IN(Instance) instance)
{
    CarriedBox box;
    box.carrier = instance;
    box.carrier.world_from_object_x = Float4(1.0f, 0.0f, 0.0f, 0.0f);
    box.carrier.world_from_object_y = Float4(0.0f, 1.0f, 0.0f, 0.0f);
    box.carrier.world_from_object_z = Float4(0.0f, 0.0f, 1.0f, 0.0f);
    box.box_min = Float3(kUnbounded, kUnbounded, kUnbounded);
    box.box_max = Float3(-kUnbounded, -kUnbounded, -kUnbounded);
    return box;
}

/// A vertex lies between the places to which each of its joints alone would carry it: so does the cluster in the box
/// around the boxes, whatever the weights. Where morph targets have the box larger than the vertices, it is larger by no more
/// than its half: stretched by a weight it holds what that weight does.
HEARTH_FUNCTION CarriedBox grownBy(HEARTH_IN(CarriedBox) box, HEARTH_IN(PaletteRow) joint, Float3 bind_min,
                                   Float3 bind_max, float stretch)
{
    HEARTH_PRECISE Float3 center = (bind_min + bind_max) * 0.5f;
    HEARTH_PRECISE Float3 half_size = (bind_max - bind_min) * (0.5f * stretch);
    Float3 row_x = row3(joint.world_from_bind_x);
    Float3 row_y = row3(joint.world_from_bind_y);
    Float3 row_z = row3(joint.world_from_bind_z);
    HEARTH_PRECISE Float3 at = Float3(dot3(row_x, center) + joint.world_from_bind_x.w,
                                      dot3(row_y, center) + joint.world_from_bind_y.w,
                                      dot3(row_z, center) + joint.world_from_bind_z.w);
    // how large the terms were that rounding errors are relative to
    HEARTH_PRECISE Float3 reach = abs3(center) + half_size;
    HEARTH_PRECISE Float3 magnitude = Float3(dot3(abs3(row_x), reach) + abs(joint.world_from_bind_x.w),
                                             dot3(abs3(row_y), reach) + abs(joint.world_from_bind_y.w),
                                             dot3(abs3(row_z), reach) + abs(joint.world_from_bind_z.w));
    HEARTH_PRECISE Float3 extent =
        Float3(dot3(abs3(row_x), half_size), dot3(abs3(row_y), half_size), dot3(abs3(row_z), half_size)) +
        magnitude * kRoundingSlack;
    HEARTH_PRECISE Float3 low = at - extent;
    HEARTH_PRECISE Float3 high = at + extent;
    CarriedBox grown = box;
    grown.box_min = Float3(min(box.box_min.x, low.x), min(box.box_min.y, low.y), min(box.box_min.z, low.z));
    grown.box_max =
        Float3(max(box.box_max.x, high.x), max(box.box_max.y, high.y), max(box.box_max.z, high.z));
    return grown;
}

/// The group as the cut looks at it. In a free pose the spheres of the cooker say nothing: all groups stand where the
/// instance does, and only their errors tell them apart.
HEARTH_FUNCTION Group groupInPose(HEARTH_IN(Group) group, HEARTH_IN(Pose) pose)
{
    Group placed = group;
    if ((pose.flags & kPoseFree) != 0u)
    {
        placed.sphere_center = pose.free_center;
        placed.sphere_radius = pose.free_radius;
    }
    return placed;
}

/// The cut rule, in any pose. `refined` is that of the cluster, or its own group where it has none.
HEARTH_FUNCTION bool deformedInCut(HEARTH_IN(FrameView) view, HEARTH_IN(Instance) instance,
                                   HEARTH_IN(Pose) pose, HEARTH_IN(DeformedCluster) cluster,
                                   HEARTH_IN(Group) own, HEARTH_IN(Group) refined)
{
    return clusterInCut(view, instance, groupInPose(own, pose), cluster.refined_group != kNoGroup,
                        groupInPose(refined, pose));
}

/// Whether the frustum test leaves a cluster to be drawn.
HEARTH_FUNCTION bool deformedInFrustum(HEARTH_IN(FrameView) view, HEARTH_IN(Instance) instance,
                                       HEARTH_IN(CarriedBox) box)
{
    return (view.flags & kCullFrustum) == 0u ||
           !boxOutsideFrustum(viewFromOrigin(view, instance), box.carrier, box.box_min, box.box_max);
}

/// Whether every triangle faces away, in a pose of the clips. joint  that of the cluster
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
    return boxFacesAway(objectEye(inverse, offset), cluster.cone, cluster.cone_back, cluster.box_min,
                        cluster.box_max);
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
