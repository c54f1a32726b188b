// Scene tables for drawing: set 0 of the visibility, material-depth and shading pipelines.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/specialization.h"

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

// formats::VertexAttributes; formats/codecs/vertex_codec.h explains the codes
const uint kVertexNormal = 1u;
const uint kVertexTangent = 2u;
const uint kVertexUv0 = 4u;
const uint kVertexUvs = 60u;
const uint kVertexColor = 64u;
const uint kVertexVisibility = 128u;
const uint kVertexNormal16 = 256u;
const uint kVertexColor16 = 512u;
const uint kVertexWideOffsets = 8192u;
const uint kVertexInfluences = 16384u;
const uint kVertexInfluences8 = 32768u;
const uint kVertexUvStepShift = 16u;

// UV sets that are stored on a grid: formats::gridUvs.
uint gridUvs(uint layout_bits)
{
    uint steps = layout_bits >> kVertexUvStepShift;
    steps |= steps >> 2;
    steps = (steps | steps >> 1) & 0x1111u;
    steps |= steps >> 3;
    steps |= steps >> 6;
    return (steps & 15u) * kVertexUv0;
}

// vertexWords: words of a vertex. uvEnd: bit at which the UV sets end; the next set starts in the bits that
// are left.
uint uvEnd(uint layout_bits, uint sets)
{
    bool wide = (layout_bits & kVertexWideOffsets) != 0u;
    uint words = wide ? 3u : 2u;
    if ((layout_bits & kVertexNormal) != 0u && (layout_bits & (kVertexNormal16 | kVertexWideOffsets)) != 0u)
        words += 1u;
    if ((layout_bits & kVertexTangent) != 0u)
        words += 1u;
    return words + uint(bitCount(layout_bits & sets)) +
           uint(bitCount(layout_bits & sets & (wide ? kVertexUvs : ~gridUvs(layout_bits))));
}

// Word of the visibility of a vertex that has one.
uint visibilityWord(uint layout_bits)
{
    uint words = uvEnd(layout_bits, kVertexUvs);
    if ((layout_bits & kVertexColor) != 0u)
        words += (layout_bits & kVertexColor16) != 0u ? 2u : 1u;
    return words;
}

// First word of the joints and weights of a vertex.
uint influenceWord(uint layout_bits)
{
    return visibilityWord(layout_bits) + ((layout_bits & kVertexVisibility) != 0u ? 1u : 0u);
}

// Joints of a vertex that has weights; each takes a word.
uint influenceCount(uint layout_bits)
{
    if ((layout_bits & kVertexInfluences) == 0u)
        return 0u;
    return (layout_bits & kVertexInfluences8) != 0u ? 8u : 4u;
}

uint vertexWords(uint layout_bits) { return influenceWord(layout_bits) + influenceCount(layout_bits); }

uint vertexCount(ClusterDraw draw) { return draw.counts & 0x1FFu; }
uint triangleCount(ClusterDraw draw) { return draw.counts >> 9 & 0xFFu; }
uint clusterLevel(ClusterDraw draw) { return draw.counts >> 17 & 0xFFu; }

// Index of a triangle corner's vertex in its cluster. Indices are bytes stored after the vertices.
uint cornerVertex(ClusterDraw draw, uint triangle, uint corner)
{
    uint index = triangle * 3u + corner;
    uint word = poolWord(draw.address + vertexCount(draw) * vertexWords(draw.vertex_layout) + (index >> 2));
    return word >> ((index & 3u) * 8u) & 0xFFu;
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
    uint x = poolWord(vertex);
    uint y = poolWord(vertex + 1u);
    ivec3 offset = (draw.vertex_layout & kVertexWideOffsets) != 0u ? ivec3(x, y, poolWord(vertex + 2u))
                                                            : ivec3(x & 0xFFFFu, x >> 16, y & 0xFFFFu);
    return vec3(ivec3(draw.base_x, draw.base_y, draw.base_z) + offset) * draw.grid_step;
}

vec3 directionFromOctahedral(vec2 p)
{
    vec3 d = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    if (d.z < 0.0)
        d.xy = (1.0 - abs(p.yx)) * vec2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
    return normalize(d);
}

// Normal of a vertex that has one.
vec3 vertexNormal(ClusterDraw draw, uint vertex)
{
    uint layout_bits = draw.vertex_layout;
    if ((layout_bits & kVertexNormal16) != 0u)
        return directionFromOctahedral(unpackSnorm2x16(poolWord(vertex + ((layout_bits & kVertexWideOffsets) != 0u ? 3u : 2u))));
    uint code = (layout_bits & kVertexWideOffsets) != 0u ? poolWord(vertex + 3u) : poolWord(vertex + 1u) >> 16;
    return directionFromOctahedral(unpackSnorm4x8(code).xy);
}

// Tangent of a vertex that has one; w = -1 if the bitangent is flipped.
vec4 vertexTangent(ClusterDraw draw, uint vertex, vec3 normal)
{
    uint code = poolWord(vertex + uvEnd(draw.vertex_layout, 0u) - 1u);
    uint quarter_bits = (draw.vertex_layout & kVertexNormal16) != 0u ? 13u : 5u;
    uint angle = code >> 1;
    float along = float(angle & ((1u << quarter_bits) - 1u)) / float(1u << quarter_bits);
    uint turn = angle >> quarter_bits;
    vec2 at = (turn & 1u) == 0u ? vec2(1.0 - along, along) : vec2(-along, 1.0 - along);
    if (turn >= 2u)
        at = -at;
    float side = normal.z < 0.0 ? -1.0 : 1.0;
    float a = -1.0 / (side + normal.z);
    float b = normal.x * normal.y * a;
    vec3 first = vec3(1.0 + side * normal.x * normal.x * a, side * b, -side * normal.x);
    vec3 second = vec3(b, side + normal.y * normal.y * a, -normal.y);
    return vec4(normalize(first * at.x + second * at.y), (code & 1u) != 0u ? -1.0 : 1.0);
}

vec2 vertexUv(ClusterDraw draw, uint vertex, uint set)
{
    uint layout_bits = draw.vertex_layout;
    uint bit = kVertexUv0 << set;
    if ((layout_bits & bit) == 0u)
        return vec2(0.0);
    uint before = (bit - 1u) & kVertexUvs;
    uint at = vertex + uvEnd(layout_bits, before);
    uint grids = gridUvs(layout_bits) & layout_bits;
    if ((grids & bit) == 0u)
        return vec2(poolFloat(at), poolFloat(at + 1u));
    // the grid bases end where the first vertex starts
    uint later_grids = uint(bitCount(grids & ~before));
    uint base = draw.address - 2u * later_grids;
    uint word = poolWord(at);
    ivec2 offset = (layout_bits & kVertexWideOffsets) != 0u ? ivec2(word, poolWord(at + 1u)) : ivec2(word & 0xFFFFu, word >> 16);
    uint fraction_bits = layout_bits >> (kVertexUvStepShift + 4u * set) & 15u;
    return vec2(ivec2(poolWord(base), poolWord(base + 1u)) + offset) * uintBitsToFloat((127u - fraction_bits) << 23);
}

vec4 vertexColor(ClusterDraw draw, uint vertex)
{
    uint layout_bits = draw.vertex_layout;
    if ((layout_bits & kVertexColor) == 0u)
        return vec4(1.0);
    uint at = vertex + uvEnd(layout_bits, kVertexUvs);
    if ((layout_bits & kVertexColor16) == 0u)
        return unpackUnorm4x8(poolWord(at));
    return vec4(unpackUnorm2x16(poolWord(at)), unpackUnorm2x16(poolWord(at + 1u)));
}

// Sky visibility code of a vertex that has one; decode with decodeVisibility of
// formats/gpu_shared/visibility_cone.h.
uint vertexVisibility(ClusterDraw draw, uint vertex) { return poolWord(vertex + visibilityWord(draw.vertex_layout)); }
