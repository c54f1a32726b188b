// Scene tables for drawing: set 0 of the visibility, material-depth and shading pipelines.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/records.h"
#include "formats/gpu_shared/specialization.h"
#include "formats/gpu_shared/vertex_layout.h"

layout(set = kSetScene, binding = kSceneFrame, std140) uniform Frame { FrameView view; };
layout(set = kSetScene, binding = kSceneInstances, std430) readonly buffer Instances { Instance instances[]; };
layout(set = kSetScene, binding = kSceneVisible, std430) readonly buffer Visible { VisibleCluster visible[]; };
layout(set = kSetScene, binding = kSceneDraws, std430) readonly buffer Draws { ClusterDraw cluster_draws[]; };
layout(set = kSetScene, binding = kScenePool, std430) readonly buffer Pool0 { uint pool0[]; };
layout(set = kSetScene, binding = kScenePool + 1u, std430) readonly buffer Pool1 { uint pool1[]; };
layout(set = kSetScene, binding = kScenePool + 2u, std430) readonly buffer Pool2 { uint pool2[]; };
layout(set = kSetScene, binding = kScenePool + 3u, std430) readonly buffer Pool3 { uint pool3[]; };

// Most scenes fit into one slice of the pool, and then reading a word needs no branch.
layout(constant_id = kConstantUsedSlices) const uint kUsedSlices = kPoolSlices;

uint poolWord(uint address)
{
    uint slice = address >> kPoolSliceAddressBits;
    uint word = address & ((1u << kPoolSliceAddressBits) - 1u);
    if (kUsedSlices == 1u || slice == 0u)
        return pool0[word];
    if (slice == 1u)
        return pool1[word];
    if (slice == 2u)
        return pool2[word];
    return pool3[word];
}

float poolFloat(uint address) { return uintBitsToFloat(poolWord(address)); }

// Address of the indices of a cluster.
uint indexAddress(ClusterDraw draw) { return draw.address + vertexCount(draw) * vertexWords(draw.vertex_layout); }

// Index of a triangle corner's vertex in its cluster.
uint cornerVertex(ClusterDraw draw, uint triangle, uint corner)
{
    uint index = triangle * 3u + corner;
    return unpackIndex(poolWord(indexAddress(draw) + (index >> 2)), index);
}

// Map a corner 0..2 to the winding order in which the bin of the instance sees the front of its triangles.
uint cornerInBin(Instance instance, uint corner)
{
    return (instance.flags & kInstanceHandednessChanged) == 0u ? corner : (3u - corner) % 3u;
}

// Address of the first word of a vertex of a cluster.
uint vertexAddress(ClusterDraw draw, uint vertex) { return draw.address + vertex * vertexWords(draw.vertex_layout); }

// Position in object space. Integers of at most 24 bits times a power of two: exact.
vec3 vertexPosition(ClusterDraw draw, uint vertex)
{
    uint third = (draw.vertex_layout & kVertexWideOffsets) != 0u ? poolWord(vertex + 2u) : 0u;
    GridOffset offset = unpackPosition(draw.vertex_layout, poolWord(vertex), poolWord(vertex + 1u), third);
    ivec3 base = ivec3(draw.base_x, draw.base_y, draw.base_z);
    return vec3(base + ivec3(offset.x, offset.y, offset.z)) * draw.grid_step;
}

// Normal of a vertex that has one.
vec3 vertexNormal(ClusterDraw draw, uint vertex)
{
    uint layout_bits = draw.vertex_layout;
    return decodeNormal(layout_bits, normalCode(layout_bits, poolWord(vertex + normalWord(layout_bits))));
}

// Tangent of a vertex that has one; w = -1 if the bitangent is flipped.
vec4 vertexTangent(ClusterDraw draw, uint vertex, vec3 normal)
{
    return decodeTangent(draw.vertex_layout, poolWord(vertex + tangentWord(draw.vertex_layout)), normal);
}

vec2 vertexUv(ClusterDraw draw, uint vertex, uint set)
{
    uint layout_bits = draw.vertex_layout;
    if ((layout_bits & (kVertexUv0 << set)) == 0u)
        return vec2(0.0);
    uint at = vertex + uvWord(layout_bits, set);
    uint fraction_bits = uvFractionBits(layout_bits, set);
    if (fraction_bits == 0u)
        return vec2(poolFloat(at), poolFloat(at + 1u));
    uint base = draw.address - uvBaseDistance(layout_bits, set);
    uint second = (layout_bits & kVertexWideOffsets) != 0u ? poolWord(at + 1u) : 0u;
    UvOffset offset = unpackUv(layout_bits, poolWord(at), second);
    return vec2(ivec2(poolWord(base), poolWord(base + 1u)) + ivec2(offset.u, offset.v)) * uvStep(fraction_bits);
}

vec4 vertexColor(ClusterDraw draw, uint vertex)
{
    uint layout_bits = draw.vertex_layout;
    if ((layout_bits & kVertexColor) == 0u)
        return vec4(1.0);
    uint at = vertex + colorWord(layout_bits);
    return decodeColor(layout_bits, poolWord(at), (layout_bits & kVertexColor16) != 0u ? poolWord(at + 1u) : 0u);
}

// Sky visibility code of a vertex that has one; decode with decodeVisibility of
// formats/gpu_shared/visibility_cone.h.
uint vertexVisibility(ClusterDraw draw, uint vertex) { return poolWord(vertex + visibilityWord(draw.vertex_layout)); }
