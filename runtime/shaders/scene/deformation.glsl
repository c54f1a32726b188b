// Poses of a scene with deformed meshes (formats/gpu_shared/deformation.h). The including file defines
// DEFORMATION_SET and DEFORMATION_BINDING for the buffer, and DEFORMATION_WRITES if it writes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/deformation.h"

#ifndef DEFORMATION_WRITES
readonly
#endif
layout(set = DEFORMATION_SET, binding = DEFORMATION_BINDING, std430) buffer Deformation { uvec4 deformation[]; };

uint deformationWord(uint word) { return deformation[word >> 2][word & 3u]; }

vec4 deformationFloats(uint row) { return uintBitsToFloat(deformation[row]); }

DeformationHeader readDeformationHeader()
{
    uvec4 a = deformation[0];
    uvec4 b = deformation[1];
    uvec4 c = deformation[2];
    return DeformationHeader(a.x, a.y, a.z, a.w, b.x, b.y, b.z, b.w, c.x, c.y, c.z, c.w);
}

#ifdef DEFORMATION_WRITES
/// Write the slots and the dispatch; the other members are the CPU's.
void writeSkinningPlan(DeformationHeader header)
{
    deformation[1] = uvec4(header.early_first, header.early_end, header.late_first, header.late_end);
    deformation[2] = uvec4(header.groups_x, header.groups_y, header.groups_z, header.group_count);
}
#endif

/// Row of the pose of an instance; 0: the instance is rigid.
uint readPoseRow(uint instance) { return deformationWord(readDeformationHeader().instance_word + instance); }

Pose loadPose(uint row)
{
    uvec4 first = deformation[row];
    vec4 second = deformationFloats(row + 1u);
    float stretch = deformationFloats(row + 2u).x;
    return Pose(first.x, first.y, first.z, first.w, second.xyz, second.w, stretch, 0u, 0u, 0u);
}

PaletteRow loadJoint(Pose pose, uint joint)
{
    uint row = pose.palette_row + joint * kPaletteRows;
    return PaletteRow(deformationFloats(row), deformationFloats(row + 1u), deformationFloats(row + 2u),
                      deformationFloats(row + 3u), deformationFloats(row + 4u), deformationFloats(row + 5u));
}

DeformedCluster loadDeformedCluster(Pose pose, uint cluster)
{
    uint row = pose.cluster_row + cluster * kDeformedClusterRows;
    uvec4 a = deformation[row];
    uvec4 b = deformation[row + 1u];
    uvec4 c = deformation[row + 2u];
    uvec4 d = deformation[row + 3u];
    uvec4 e = deformation[row + 4u];
    return DeformedCluster(uintBitsToFloat(a.xyz), a.w, uintBitsToFloat(b.xyz), b.w, uintBitsToFloat(c.xyz),
                           uintBitsToFloat(c.w), uintBitsToFloat(d.xyz), d.w, e.x, e.y, e.z, e.w);
}

TransformedBox boxInPose(Instance instance, Pose pose, DeformedCluster cluster)
{
    PaletteRow main_joint = loadJoint(pose, cluster.joint);
    if ((pose.flags & kPoseFree) == 0u)
    {
        TransformedBox framed = boxInClips(instance, main_joint, cluster);
        for (uint i = 1u; i < cluster.joint_count; ++i)
        {
            uint word = deformationWord(cluster.first_joint + i);
            if (frameShare(word) == 0.0f)
                break;
            framed = shareFrame(framed, main_joint, loadJoint(pose, listedJoint(word)), frameShare(word));
        }
        return framed;
    }
    TransformedBox box = growByJoint(makeEmptyFreeBox(instance), main_joint, cluster.bind_min, cluster.bind_max,
                             pose.free_box_scale);
    // joint 0 of the list is the main one; without a skin there are none
    for (uint i = 1u; i < cluster.joint_count; ++i)
        box = growByJoint(box, loadJoint(pose, listedJoint(deformationWord(cluster.first_joint + i))), cluster.bind_min,
                          cluster.bind_max, pose.free_box_scale);
    return box;
}

/// Word of the block with the skinned vertices of a slot; 0: none, its vertices are skinned on demand.
uint readScratchBlock(uint slot)
{
    DeformationHeader header = readDeformationHeader();
    bool early = slot >= header.early_first && slot < header.early_end;
    uint block = early ? slot - header.early_first : header.early_end - header.early_first + (slot - header.late_first);
    return block < header.block_count ? header.scratch_word + block * header.block_words : 0u;
}
