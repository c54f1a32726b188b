// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/mesh/source_mesh.h"

#include "formats/base/byte_reader.h"

#include <algorithm>
#include <cstring>

namespace hearth::mesh
{

using namespace formats;

namespace
{

constexpr uint64_t kArrayAlignment = 16;

/// Collects arrays and lays them out as one chunk.
class ArrayPacker
{
public:
    template <typename T>
    void add(SourceSemantic semantic, uint32_t set, const std::vector<T>& values,
             uint32_t element_size = sizeof(T))
    {
        if (values.empty())
            return;
        SourceArray array{};
        array.semantic = static_cast<uint32_t>(semantic);
        array.set = set;
        array.count = values.size() * sizeof(T) / element_size;
        array.element_size = element_size;
        arrays_.push_back(array);
        contents_.push_back(std::as_bytes(std::span(values)));
    }

    std::vector<std::byte> pack(SourceMeshHeader header)
    {
        header.array_count = static_cast<uint32_t>(arrays_.size());
        uint64_t end = sizeof(SourceMeshHeader) + arrays_.size() * sizeof(SourceArray);
        for (size_t i = 0; i < arrays_.size(); ++i)
        {
            arrays_[i].offset = (end + kArrayAlignment - 1) / kArrayAlignment * kArrayAlignment;
            end = arrays_[i].offset + contents_[i].size();
        }
        std::vector<std::byte> bytes(end);
        std::memcpy(bytes.data(), &header, sizeof(header));
        if (!arrays_.empty())
            std::memcpy(bytes.data() + sizeof(header), arrays_.data(), arrays_.size() * sizeof(SourceArray));
        for (size_t i = 0; i < arrays_.size(); ++i)
            std::memcpy(bytes.data() + arrays_[i].offset, contents_[i].data(), contents_[i].size());
        return bytes;
    }

private:
    std::vector<SourceArray> arrays_;
    std::vector<std::span<const std::byte>> contents_;
};

void addDeformation(ArrayPacker& packer, const SourceMesh& mesh)
{
    for (uint32_t set = 0; set < mesh.joint_sets.size(); ++set)
    {
        packer.add(SourceSemantic::joints, set, mesh.joint_sets[set]);
        packer.add(SourceSemantic::weights, set, mesh.weight_sets[set]);
    }
    for (uint32_t target = 0; target < mesh.morph_targets.size(); ++target)
    {
        packer.add(SourceSemantic::morph_position, target, mesh.morph_targets[target].positions);
        packer.add(SourceSemantic::morph_normal, target, mesh.morph_targets[target].normals);
        packer.add(SourceSemantic::morph_tangent, target, mesh.morph_targets[target].tangents);
    }
}

SourceMeshHeader makeHeader(const SourceMesh& mesh)
{
    SourceMeshHeader header{};
    header.face_count = mesh.face_count;
    header.vertex_count = static_cast<uint32_t>(mesh.vertexCount());
    header.triangle_count = static_cast<uint32_t>(mesh.triangleCount());
    header.source_vertex_count = mesh.source_vertex_count;
    // writeSourceMesh appends the name behind the arrays and sets its offset
    header.name = {0, static_cast<uint32_t>(mesh.name.size())};
    return header;
}

template <typename T>
bool copyArray(std::span<const std::byte> bytes, const SourceArray& array, uint64_t expected_count,
               std::vector<T>& out, uint32_t element_size = sizeof(T))
{
    if (array.element_size != element_size || array.count != expected_count)
        return false;
    const auto part = checkedPart(bytes, array.offset, array.count, array.element_size);
    if (!part)
        return false;
    out.resize(part->size() / sizeof(T));
    if (!part->empty())
        std::memcpy(out.data(), part->data(), part->size());
    return true;
}

template <typename T>
T& growToSet(std::vector<T>& sets, uint32_t set)
{
    if (sets.size() <= set)
        sets.resize(set + 1);
    return sets[set];
}

// More sets than any exporter writes; only a limit for damaged parts.
constexpr uint32_t kMaxSets = 4096;

bool readArray(std::span<const std::byte> bytes, const SourceMeshHeader& header, const SourceArray& array,
               SourceMesh& mesh)
{
    const uint64_t vertices = header.vertex_count;
    const uint64_t triangles = header.triangle_count;
    if (array.set >= kMaxSets)
        return false;
    switch (static_cast<SourceSemantic>(array.semantic))
    {
    case SourceSemantic::position:
        return copyArray(bytes, array, vertices, mesh.positions);
    case SourceSemantic::normal:
        return copyArray(bytes, array, vertices, mesh.normals);
    case SourceSemantic::tangent:
        return copyArray(bytes, array, vertices, mesh.tangents);
    case SourceSemantic::uv:
        return array.set < kUvSetCount && copyArray(bytes, array, vertices, mesh.uvs[array.set]);
    case SourceSemantic::color:
        return copyArray(bytes, array, vertices, mesh.colors);
    case SourceSemantic::joints:
        return copyArray(bytes, array, vertices, growToSet(mesh.joint_sets, array.set));
    case SourceSemantic::weights:
        return copyArray(bytes, array, vertices, growToSet(mesh.weight_sets, array.set));
    case SourceSemantic::index:
        return copyArray(bytes, array, triangles, mesh.indices, 3 * sizeof(uint32_t));
    case SourceSemantic::triangle_material:
        return copyArray(bytes, array, triangles, mesh.triangle_materials);
    case SourceSemantic::morph_position:
        return copyArray(bytes, array, vertices, growToSet(mesh.morph_targets, array.set).positions);
    case SourceSemantic::morph_normal:
        return copyArray(bytes, array, vertices, growToSet(mesh.morph_targets, array.set).normals);
    case SourceSemantic::morph_tangent:
        return copyArray(bytes, array, vertices, growToSet(mesh.morph_targets, array.set).tangents);
    }
    return false;
}

} // namespace

uint32_t attributeBits(const SourceMesh& mesh)
{
    uint32_t attributes = 0;
    attributes |= mesh.normals.empty() ? 0u : kVertexNormal;
    attributes |= mesh.tangents.empty() ? 0u : kVertexTangent;
    for (size_t set = 0; set < kUvSetCount; ++set)
        attributes |= mesh.uvs[set].empty() ? 0u : kVertexUv0 << set;
    attributes |= mesh.colors.empty() ? 0u : kVertexColor;
    attributes |= mesh.joint_sets.empty() ? 0u : kVertexInfluences;
    attributes |= mesh.joint_sets.size() < 2 ? 0u : kVertexInfluences8;
    return attributes;
}

Status writeSourceMesh(ContainerWriter& writer, uint32_t index, const SourceMesh& mesh)
{
    HEARTH_ASSERT(mesh.triangle_materials.size() == mesh.triangleCount());
    ArrayPacker packer;
    packer.add(SourceSemantic::position, 0, mesh.positions);
    packer.add(SourceSemantic::normal, 0, mesh.normals);
    packer.add(SourceSemantic::tangent, 0, mesh.tangents);
    for (uint32_t set = 0; set < kUvSetCount; ++set)
        packer.add(SourceSemantic::uv, set, mesh.uvs[set]);
    packer.add(SourceSemantic::color, 0, mesh.colors);
    packer.add(SourceSemantic::index, 0, mesh.indices, 3 * sizeof(uint32_t));
    packer.add(SourceSemantic::triangle_material, 0, mesh.triangle_materials);
    addDeformation(packer, mesh);
    SourceMeshHeader header = makeHeader(mesh);
    std::vector<std::byte> bytes = packer.pack(header);
    header.name.offset = static_cast<uint32_t>(bytes.size());
    std::memcpy(bytes.data() + offsetof(SourceMeshHeader, name), &header.name, sizeof(header.name));
    const auto name = std::as_bytes(std::span(mesh.name));
    bytes.insert(bytes.end(), name.begin(), name.end());
    return writer.addChunk({.type = kChunkSourceMesh, .index = index}, bytes, 1, Codec::none);
}

Result<SourceMesh> readSourceMesh(const ContainerReader& reader, uint32_t index)
{
    const std::string where = chunkName(kChunkSourceMesh, index);
    const auto damaged = [&](const char* what) {
        return Error{Issue::chunk_size, reader.name(), where, what};
    };
    const ChunkEntry* entry = reader.find(kChunkSourceMesh, index);
    if (entry == nullptr)
        return Error{Issue::chunk_missing, reader.name(), where, ""};
    HEARTH_ASSIGN_OR_RETURN(const ChunkData data, reader.read(kChunkSourceMesh, index));

    ByteReader bytes(data.bytes());
    const auto header = bytes.read<SourceMeshHeader>();
    if (!header)
        return damaged("too short for its header");
    SourceMesh mesh;
    for (uint32_t i = 0; i < header->array_count; ++i)
    {
        const auto array = bytes.read<SourceArray>();
        if (!array || !readArray(data.bytes(), *header, *array, mesh))
            return damaged("an array does not fit");
    }
    const auto name = checkedPart(data.bytes(), header->name.offset, header->name.length);
    if (!name)
        return damaged("the name does not fit");
    mesh.name.assign(reinterpret_cast<const char*>(name->data()), name->size());
    mesh.face_count = header->face_count;
    mesh.source_vertex_count = header->source_vertex_count;
    if (mesh.vertexCount() != header->vertex_count || mesh.triangleCount() != header->triangle_count ||
        mesh.triangle_materials.size() != mesh.triangleCount() ||
        mesh.joint_sets.size() != mesh.weight_sets.size())
        return damaged("arrays are missing");
    if (std::any_of(mesh.indices.begin(), mesh.indices.end(),
                    [&](uint32_t i) { return i >= header->vertex_count; }))
        return Error{Issue::index_out_of_range, reader.name(), where, ""};
    reader.discard(*entry); // everything is copied
    return mesh;
}

} // namespace hearth::mesh
