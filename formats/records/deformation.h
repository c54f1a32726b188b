// Chunks of meshes that skins and morph targets deform: bounds of their clusters over all poses. See
// FORMAT.md, "Deformed meshes". Poses are computed by formats/scene/animation.h. The palette of an instance
// has one matrix for each joint of its skin, from the bind pose to the world; without a skin, only the
// transform of its node.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/container.h"

namespace hearth::formats
{

inline constexpr uint32_t kChunkDeformedMeshes = fourCC("DMSH");   ///< DeformedMeshRecord[]
inline constexpr uint32_t kChunkDeformedClusters = fourCC("DCLU"); ///< DeformedClusterRecord[]
/// u32[]: joints that move a cluster, each with its share in the cluster's frame
inline constexpr uint32_t kChunkClusterJoints = fourCC("DJNT");
inline constexpr uint32_t kChunkDeformedGroups = fourCC("DGRP"); ///< DeformedGroupRecord[]

/// Mesh with joints and weights or with morph targets; records ascend by mesh. Bounds hold for all clips of
/// its scene at all times, for blends of any two clips and for the rest pose, with morph weights from 0 to 1.
/// "In joint j" means the bind pose transformed by row j of the palette: a point p in joint j is at
/// palette[j] * p.
struct DeformedMeshRecord
{
    uint32_t mesh;
    uint32_t skin;
    uint32_t anchor;
    uint32_t reserved;
    Range clusters;
    Float3 box_min;
    Float3 box_max;
};

/// Bounds of a cluster over all poses. The frame of a cluster in a pose is the sum of the palette's matrices
/// by the shares of its joints: a point p in the frame is at sum_j share_j palette[j] * p. The apex of the
/// normal cone is cone_back behind the middle of the box, against the axis, with the box put in the joint.
struct DeformedClusterRecord
{
    Float3 box_min;
    uint16_t joint;
    uint16_t cone_axis;
    Float3 box_max;
    uint16_t cone_cutoff;
    uint16_t reserved;
    float cone_back;
    Range joints;
    float morph_reach;
};

/// Sum of the shares of a cluster's joints in its frame, the main bone's among them.
inline constexpr uint32_t kWholeShare = 65536;

/// Return an entry of chunk DJNT.
/// joint  of the skin, below 65536
/// share  in the cluster's frame, in 1/65536; 0 for the main bone, which has the rest
constexpr uint32_t clusterJoint(uint32_t joint, uint32_t share)
{
    return joint | share << 16;
}
constexpr uint32_t jointIndex(uint32_t entry)
{
    return entry & 0xffff;
}
constexpr uint32_t jointShare(uint32_t entry)
{
    return entry >> 16;
}

/// Parts only: bounding sphere of group `group` of a deformed mesh, for chunk GRUP of the pack.
struct DeformedGroupRecord
{
    Float3 sphere_center;
    float sphere_radius;
    uint32_t group;
};

} // namespace hearth::formats

HEARTH_RECORD(hearth::formats::DeformedMeshRecord, 48,
              HEARTH_FIELD(hearth::formats::DeformedMeshRecord, mesh, "mesh"),
              HEARTH_FIELD(hearth::formats::DeformedMeshRecord, skin, "skin, or none: morph targets alone"),
              HEARTH_FIELD(hearth::formats::DeformedMeshRecord, anchor,
                           "joint of the skin that the box and the spheres of the mesh's groups are in"),
              HEARTH_FIELD(hearth::formats::DeformedMeshRecord, reserved, "0"),
              HEARTH_FIELD(hearth::formats::DeformedMeshRecord, clusters,
                           "chunk DCLU: as many as the mesh has in chunk CLUS, in the same order"),
              HEARTH_FIELD(hearth::formats::DeformedMeshRecord, box_min, "in the anchor, all poses"),
              HEARTH_FIELD(hearth::formats::DeformedMeshRecord, box_max, "in the anchor, all poses"));
HEARTH_RECORD(
    hearth::formats::DeformedClusterRecord, 48,
    HEARTH_FIELD(hearth::formats::DeformedClusterRecord, box_min, "in the cluster's frame, all poses"),
    HEARTH_FIELD(hearth::formats::DeformedClusterRecord, joint,
                 "main bone: joint of the skin; 0 without a skin"),
    HEARTH_FIELD(hearth::formats::DeformedClusterRecord, cone_axis,
                 "normal cone in the joint, all poses: octahedral, 2 x snorm8"),
    HEARTH_FIELD(hearth::formats::DeformedClusterRecord, box_max, "in the cluster's frame, all poses"),
    HEARTH_FIELD(hearth::formats::DeformedClusterRecord, cone_cutoff,
                 "sine of the half-angle in 1/65536, rounded up; 65535: the cone never culls"),
    HEARTH_FIELD(hearth::formats::DeformedClusterRecord, reserved, "0"),
    HEARTH_FIELD(hearth::formats::DeformedClusterRecord, cone_back,
                 "metres in the joint: every triangle's plane has the apex on or behind its front"),
    HEARTH_FIELD(
        hearth::formats::DeformedClusterRecord, joints,
        "chunk DJNT: all joints that move a vertex, the main bone first, those with a share in the frame "
        "next; none without a skin"),
    HEARTH_FIELD(
        hearth::formats::DeformedClusterRecord, morph_reach,
        "metres: how far on any axis of the bind pose morph targets take a vertex at most, with weights "
        "from -1 to 1"));
HEARTH_RECORD(hearth::formats::DeformedGroupRecord, 20,
              HEARTH_FIELD(hearth::formats::DeformedGroupRecord, sphere_center, "in the anchor, all poses"),
              HEARTH_FIELD(hearth::formats::DeformedGroupRecord, sphere_radius,
                           "contains the spheres of all refined groups"),
              HEARTH_FIELD(hearth::formats::DeformedGroupRecord, group, "of the clusters part"));
