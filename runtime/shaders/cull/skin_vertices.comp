// Skins the vertices of deformed clusters for the visibility pass and shading. One workgroup per deformed
// cluster of the visible list, as many as the scratch buffer holds. Writes the positions of all vertices,
// then normals and tangents if the vertices have them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/deformation.h"
#include "formats/gpu_shared/push_constants.h"
#include "runtime/shaders/scene/scene.glsl"
#define DEFORMATION_SET kSetScene
#define DEFORMATION_BINDING kSceneDeformation
#define DEFORMATION_WRITES
#include "runtime/shaders/scene/deformation.glsl"
#include "runtime/shaders/scene/pose_vertex.glsl"

layout(local_size_x = 64) in;
layout(push_constant) uniform Push { PhasePush push; };

void writeVector(uint word, vec3 v)
{
    uvec3 bits = floatBitsToUint(v);
    for (uint i = 0u; i < 3u; ++i)
        deformation[(word + i) >> 2][(word + i) & 3u] = bits[i];
}

void main()
{
    uint at = gl_WorkGroupID.y * kMaxDispatchX + gl_WorkGroupID.x;
    DeformationHeader header = readDeformationHeader();
    if (at >= header.group_count)
        return;
    uint slot = (push.phase == kPhaseLate ? header.late_first : header.early_first) + at;
    VisibleCluster shown = visible[slot];
    ClusterDraw draw = cluster_draws[shown.cluster];
    Pose pose = loadPose(readPoseRow(shown.instance));
    uint scratch = readScratchBlock(slot);
    uint count = vertexCount(draw);
    for (uint i = gl_LocalInvocationIndex; i < count; i += 64u)
    {
        writeVector(scratch + i * 3u, posedPosition(draw, pose, i));
        if ((draw.vertex_layout & kVertexNormal) != 0u)
            writeVector(scratch + (count + i) * 3u, posedNormal(draw, pose, i));
        if ((draw.vertex_layout & kVertexTangent) != 0u)
            writeVector(scratch + (2u * count + i) * 3u, posedTangent(draw, pose, i));
    }
}
