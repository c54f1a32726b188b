// The scene as drawing reads it: set 0 of the visibility, material-depth and shading pipelines.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided

layout(set = 0, binding = 0, std140) uniform Frame { FrameView view; };
layout(set = 0, binding = 1, std430) readonly buffer Instances { Instance instances[]; };
layout(set = 0, binding = 2, std430) readonly buffer Visible { VisibleCluster visible[]; };
layout(set = 0, binding = 3, std430) readonly buffer Draws { ClusterDraw cluster_draws[]; };
layout(set = 0, binding = 4, std430) readonly buffer Pool0 { uint pool0[]; };
layout(set = 0, binding = 5, std430) readonly buffer Pool1 { uint pool1[]; };
layout(set = 0, binding = 6, std430) readonly buffer Pool2 { uint pool2[]; };
layout(set = 0, binding = 7, std430) readonly buffer Pool3 { uint pool3[]; };

// Slices that the scene uses: 1 or kPoolSlices. Most scenes fit into one, and then no word costs a choice.
layout(constant_id = 0) const uint kUsedSlices = kPoolSlices;

uint poolWord(uint address)
{
    uint slice = address >> kPoolSliceBits;
    uint word = address & ((1u << kPoolSliceBits) - 1u);
    if (kUsedSlices == 1u || slice == 0u)
        return pool0[word];
    if (slice == 1u)
        return pool1[word];
    if (slice == 2u)
        return pool2[word];
    return pool3[word];
}

float poolFloat(uint address) { return uintBitsToFloat(poolWord(address)); }

vec3 poolFloat3(uint address)
{
    return vec3(poolFloat(address), poolFloat(address + 1u), poolFloat(address + 2u));
}

// formats::VertexAttributes
const uint kVertexNormal = 1u;
const uint kVertexTangent = 2u;
const uint kVertexUv0 = 4u;
const uint kVertexColor = 64u;

// Words of a vertex with these attributes; with fewer bits, where the next attribute starts.
uint vertexWords(uint attributes)
{
    return 3u + uint(bitCount(attributes & 3u)) + 2u * uint(bitCount(attributes & 124u));
}

uint attributeWord(uint attributes, uint bit) { return vertexWords(attributes & (bit - 1u)); }

uint vertexCount(ClusterDraw draw) { return draw.counts & 0x1FFu; }
uint triangleCount(ClusterDraw draw) { return draw.counts >> 9 & 0xFFu; }
uint levelOf(ClusterDraw draw) { return draw.counts >> 17; }

// Address of the first word of a corner's vertex. Indices are bytes behind the vertices.
uint cornerAddress(ClusterDraw draw, uint triangle, uint corner)
{
    uint words = vertexWords(draw.attributes);
    uint index = triangle * 3u + corner;
    uint word = poolWord(draw.address + vertexCount(draw) * words + (index >> 2));
    return draw.address + (word >> ((index & 3u) * 8u) & 0xFFu) * words;
}

vec2 vertexUv(ClusterDraw draw, uint vertex, uint set)
{
    uint bit = kVertexUv0 << set;
    if ((draw.attributes & bit) == 0u)
        return vec2(0.0);
    uint at = vertex + attributeWord(draw.attributes, bit);
    return vec2(poolFloat(at), poolFloat(at + 1u));
}

vec4 vertexColor(ClusterDraw draw, uint vertex)
{
    if ((draw.attributes & kVertexColor) == 0u)
        return vec4(1.0);
    uint at = vertex + attributeWord(draw.attributes, kVertexColor);
    return vec4(unpackUnorm2x16(poolWord(at)), unpackUnorm2x16(poolWord(at + 1u)));
}
