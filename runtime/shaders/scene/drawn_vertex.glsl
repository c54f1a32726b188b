// Vertices of the slots of the visible list as drawn, of rigid and of deformed instances. Include after
// scene.glsl.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/specialization.h"
#define DEFORMATION_SET kSetScene
#define DEFORMATION_BINDING kSceneDeformation
#include "runtime/shaders/scene/deformation.glsl"
#include "runtime/shaders/scene/pose_vertex.glsl"
#ifdef HEARTH_MATERIAL_FUNCTIONS
#include "runtime/shaders/scene/material_motion.glsl"
#endif

layout(constant_id = kConstantDeformed) const uint kDeformed = kDeformedNone;

struct DrawnPose
{
    uint row;     // of the pose; 0: the instance is rigid
    uint scratch; // word of the pre-skinned vertices; 0: none
};

DrawnPose drawnPose(uint instance, uint slot)
{
    DrawnPose pose = DrawnPose(0u, 0u);
    if (kDeformed == kDeformedNone)
        return pose;
    pose.row = readPoseRow(instance);
    if (kDeformed == kDeformedPreSkinned && pose.row != 0u)
        pose.scratch = readScratchBlock(slot);
    return pose;
}

vec3 scratchVector(uint word)
{
    return uintBitsToFloat(uvec3(deformationWord(word), deformationWord(word + 1u), deformationWord(word + 2u)));
}

// Position relative to the eye, world axes. index: index of the vertex in its cluster.
vec3 drawnPosition(Instance instance, ClusterDraw draw, DrawnPose pose, uint index, vec3 eye)
{
    if (kDeformed == kDeformedNone || pose.row == 0u)
    {
        vec3 at_rest = vertexPosition(draw, vertexAddress(draw, index));
#ifdef HEARTH_MATERIAL_FUNCTIONS
        precise vec3 moved = toEyeRelative(instance, eye, at_rest) + vertexMotion(instance, at_rest);
        return moved;
#else
        return toEyeRelative(instance, eye, at_rest);
#endif
    }
    precise vec3 position = pose.scratch != 0u ? scratchVector(pose.scratch + index * 3u)
                                               : posedPosition(draw, loadPose(pose.row), index);
    precise vec3 origin = vec3(instance.world_from_object_x.w - eye.x, instance.world_from_object_y.w - eye.y,
                               instance.world_from_object_z.w - eye.z);
    precise vec3 relative = position + origin;
    return relative;
}

// Normal of a deformed instance, unit, world axes; so are the two functions below. The vertex has a normal.
vec3 drawnNormal(ClusterDraw draw, DrawnPose pose, uint index)
{
    return pose.scratch != 0u ? scratchVector(pose.scratch + (vertexCount(draw) + index) * 3u)
                              : posedNormal(draw, loadPose(pose.row), index);
}

// Tangent of a deformed instance. The vertex has a tangent.
vec3 drawnTangent(ClusterDraw draw, DrawnPose pose, uint index)
{
    return pose.scratch != 0u ? scratchVector(pose.scratch + (2u * vertexCount(draw) + index) * 3u)
                              : posedTangent(draw, loadPose(pose.row), index);
}
