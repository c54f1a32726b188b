// Triangle mesh in memory, as import delivers it and the cookers read it, and its serialized form in a part
// (chunk SMSH).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"
#include "formats/container/container_reader.h"
#include "formats/container/container_writer.h"
#include "formats/records/mesh.h"

#include <array>
#include <string>
#include <vector>

namespace hearth::mesh
{

inline constexpr size_t kUvSetCount = 4;

struct Joints4
{
    uint16_t joint[4];
};

/// Deltas to the bind pose; an array is empty if the target does not change that attribute.
struct MorphTarget
{
    std::vector<Float3> positions;
    std::vector<Float3> normals;
    std::vector<Float3> tangents;
};

/// Mesh of the source: all its primitives together, one material for each triangle. Every attribute array is
/// empty or has vertexCount() elements; all values are finite; indices are in range. Vertices are in the bind
/// pose: joints and morph targets are not applied. Triangles without area are still included: the cookers
/// drop and count them.
struct SourceMesh
{
    std::string name;
    std::vector<Float3> positions; ///< metres, object space
    std::vector<Float3> normals;   ///< unit
    std::vector<Float4> tangents;  ///< unit xyz; w = +-1, bitangent = w * cross(normal, tangent)
    std::array<std::vector<Float2>, kUvSetCount> uvs;
    std::vector<Float4> colors;                   ///< linear RGBA, 0..1
    std::vector<std::vector<Joints4>> joint_sets; ///< four influences a set; as many sets as weight_sets
    std::vector<std::vector<Float4>> weight_sets; ///< over all sets, a vertex's weights sum to 1
    std::vector<uint32_t> indices;                ///< three for each triangle
    std::vector<uint32_t> triangle_materials;     ///< material of each triangle, or kInvalidIndex
    std::vector<MorphTarget> morph_targets;
    uint32_t face_count = 0;          ///< polygons of the source before triangulation
    uint32_t source_vertex_count = 0; ///< as the source counts them (glTF: its distinct POSITION accessors)

    size_t vertexCount() const { return positions.size(); }
    size_t triangleCount() const { return indices.size() / 3; }
};

/// Return the bits of formats::VertexAttributes for the arrays that are not empty.
uint32_t attributeBits(const SourceMesh& mesh);

/// Write the mesh as chunk SMSH `index`.
Status writeSourceMesh(formats::ContainerWriter& writer, uint32_t index, const SourceMesh& mesh);

/// Read chunk SMSH `index` back. errors: chunk_missing, chunk_size, index_out_of_range and those of the
/// container.
Result<SourceMesh> readSourceMesh(const formats::ContainerReader& reader, uint32_t index);

} // namespace hearth::mesh
