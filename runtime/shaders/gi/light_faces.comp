// Updates the light (GI) of the brick faces that are due in this frame, one thread per face.
// formats/gpu_shared/brick_lighting.h has the iteration.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/bindings.h"
#define LIVE_LIGHT_ALONE
#include "runtime/shaders/scene/bricks.glsl"

layout(local_size_x = kGroupFaces) in;

// lights of the faces due in this frame, in order; copied to the buffer that is read when all are done
layout(set = kSetFreshLight, binding = kFreshLightFaces, std430) writeonly buffer FreshLights { BrickLight fresh_lights[]; };
layout(set = kSetFreshLight, binding = kFreshLightLocations, std430) readonly buffer BrickPlaces { BrickLocation brick_places[]; };

// Find the last due brick whose first face is not after this one. Bricks without faces come before it.
uint findBrickOfFace(uint face)
{
    uint least = brick_view.first_brick;
    uint most = least + brick_view.slice_bricks - 1u;
    while (least < most)
    {
        uint middle = (least + most + 1u) >> 1;
        if (bricks[middle].first_face <= face)
            least = middle;
        else
            most = middle - 1u;
    }
    return least;
}

// Mask of the voxels of a brick that have a face on this side.
uvec2 faceMask(uint brick, uint side) { return uvec2(bricks[brick].face_masks[2u * side], bricks[brick].face_masks[2u * side + 1u]); }

// Find the set bit of a mask that has `rank` set bits below it.
uint findNthBit(uint low, uint high, uint rank)
{
    uint low_count = uint(bitCount(low));
    uint word = rank < low_count ? low : high;
    for (uint left = rank < low_count ? rank : rank - low_count; left > 0u; --left)
        word &= word - 1u;
    return uint(findLSB(word)) + (rank < low_count ? 0u : 32u);
}

float emissionFactor(vec3 middle)
{
    float factor = 1.0;
    for (uint i = 0u; i < brick_view.emission_box_count; ++i)
    {
        EmissionBox box = brick_view.emission_boxes[i];
        if (all(greaterThanEqual(middle, box.box_min)) && all(lessThanEqual(middle, box.box_max)))
            factor = box.factor;
    }
    return factor;
}

// True if the faces have this light already, baked: light is added, so each part bounces on its own.
bool isOnFaces(Light light) { return (brick_view.light_parts & kBakedFaceLight) != 0u && (light.reflector_axis & kLightOnFaces) != 0u; }

// Lights that may reach the faces of the workgroup, and the box of their voxels.
shared uint marks[kMaxLights / 32u];
shared int box_low[3];
shared int box_high[3];

// Voxels by which a surface may lie beside the voxel of its face.
const float kBoxMargin = 2.0;

void beginMarks()
{
    for (uint i = gl_LocalInvocationIndex; i < kMaxLights / 32u; i += kGroupFaces)
        marks[i] = 0u;
    if (gl_LocalInvocationIndex < 3u)
    {
        box_low[gl_LocalInvocationIndex] = 0x7FFFFFFF;
        box_high[gl_LocalInvocationIndex] = 0;
    }
    barrier();
}

void addToBox(uvec3 voxel)
{
    for (uint axis = 0u; axis < 3u; ++axis)
    {
        atomicMin(box_low[axis], int(voxel[axis]));
        atomicMax(box_high[axis], int(voxel[axis]) + 1);
    }
}

// Mark the lights whose range meets the box.
void markLights()
{
    BrickGrid grid = brick_view.grid;
    vec3 low = vec3(box_low[0], box_low[1], box_low[2]) - kBoxMargin;
    vec3 high = vec3(box_high[0], box_high[1], box_high[2]) + kBoxMargin;
    for (uint i = gl_LocalInvocationIndex; i < lighting.light_count; i += kGroupFaces)
    {
        Light light = lights[i];
        vec3 place = (light.position - grid.origin) / grid.voxel_size;
        vec3 off = place - clamp(place, low, high);
        float reach = light.range / grid.voxel_size;
        bool is_unranged = light.type == kLightDirectional || light.range <= 0.0;
        bool is_off = light.intensity == vec3(0.0);
        if (!is_off && !isOnFaces(light) && (is_unranged || dot(off, off) <= reach * reach))
            atomicOr(marks[i >> 5], 1u << (i & 31u));
    }
    barrier();
}

void main()
{
    uint in_share = (gl_WorkGroupID.x + gl_WorkGroupID.y * kMaxDispatchX) * kGroupFaces + gl_LocalInvocationID.x;
    bool is_due = in_share < brick_view.slice_faces;
    beginMarks();
    // threads without a face take the last one, since all have to meet the barriers
    uint face = bricks[brick_view.first_brick].first_face + min(in_share, brick_view.slice_faces - 1u);
    uint number = findBrickOfFace(face);
    uint side = 0u;
    uint rank = face - bricks[number].first_face;
    uvec2 mask = faceMask(number, side);
    for (uint count = maskCount(mask.x, mask.y); rank >= count; count = maskCount(mask.x, mask.y))
    {
        rank -= count;
        mask = faceMask(number, ++side);
    }
    uint bit = findNthBit(mask.x, mask.y, rank);
    BrickLocation place = brick_places[number];
    uint x = (place.xy & 0xFFFFu) + (bit & 3u);
    uint y = (place.xy >> 16) + (bit >> 2 & 3u);
    uint z = place.z + (bit >> 4);
    if (is_due)
        addToBox(uvec3(x, y, z));
    barrier();
    markLights();
    if (!is_due)
        return;

    BrickGrid grid = brick_view.grid;
    BrickStart start = brickFaceStart(grid, x, y, z, side, brickNormalAt(face), brickFaceSurface(x, y, z, side, brickDepthAt(face)));
    // emission and the sky are baked with the lamps
    bool is_baked = (brick_view.light_parts & kBakedFaceLight) != 0u;
    Sky sky = sceneSky();
    if (is_baked)
        sky = Sky(vec3(0.0), vec3(0.0), vec3(0.0), kNoSkyImage);
    vec3 arrived = brickGather(grid, sky, start, brick_view.light_rays, brickFaceSeed(x, y, z, side));
    for (uint word = 0u; word < (lighting.light_count + 31u) / 32u; ++word)
        for (uint bits = marks[word]; bits != 0u; bits &= bits - 1u)
            arrived += brickDirect(grid, start, lights[word * 32u + uint(findLSB(bits))]);
    vec3 emission = vec3(0.0);
    if (!is_baked)
        emission = brickEmissionAt(face) * (lighting.exposure * emissionFactor(vec3(x, y, z) + 0.5));
    fresh_lights[in_share] = encodeBrickLight(brickOutgoingRadiance(emission, brickAlbedoAt(face), arrived));
}
