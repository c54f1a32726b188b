// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/small_parts.h"

#include "formats/base/assert.h"

#include <algorithm>
#include <fstream>

namespace hearth::test
{

using namespace formats;

namespace
{

const uint32_t kClusterChunks[] = {kChunkMeshes,   kChunkLevels,       kChunkGroups,
                                   kChunkClusters, kChunkPageTable,    kChunkPageParents,
                                   kChunkPages,    kChunkSurroundings, kChunkRadianceTransfers};

const uint32_t kSkinningChunks[] = {kChunkDeformedMeshes, kChunkDeformedClusters, kChunkClusterJoints};

bool isOneOfTypes(uint32_t type, std::span<const uint32_t> types)
{
    return std::find(types.begin(), types.end(), type) != types.end();
}

void writeFile(const std::string& path, const AlignedBytes& bytes)
{
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.span().data()),
               static_cast<std::streamsize>(bytes.size()));
    HEARTH_ASSERT(file.flush().good());
}

} // namespace

std::string importMeta(const std::string& name)
{
    return R"({"schema":"hearth.import/1","tool":{"name":"hearth-import","version":"0"},"source":"/where/)" +
           name + R"(","sources":[{"name":")" + name +
           R"(","bytes":100,"xxh3":"00000000000000ab"}],)"
           R"("counts":{"triangles":9,"vertices":27,"materials":1,"joints":2,"animations":2},)"
           R"("messages":[{"code":"W1400","severity":"warning","pointer":"/extras","text":"extras","hint":""}],)"
           R"("messages_left_out":3,"dropped":["extras"]})";
}

void writeParts(const PackModel& pack, const std::string& folder, const std::string& prefix)
{
    std::vector<ChunkImage> import_chunks;
    std::vector<ChunkImage> clusters_chunks;
    std::vector<ChunkImage> textures_chunks;
    std::vector<ChunkImage> skinning_chunks;
    const uint32_t shared[] = {kChunkStrings};
    const uint32_t textures[] = {kChunkImages, kChunkImageData};
    for (const ChunkImage& chunk : pack.chunks(true))
    {
        const uint32_t type = chunk.entry.type;
        if (isOneOfTypes(type, kClusterChunks) || isOneOfTypes(type, shared))
            clusters_chunks.push_back(chunk);
        if (isOneOfTypes(type, kSkinningChunks))
            skinning_chunks.push_back(chunk);
        else if (!isOneOfTypes(type, kClusterChunks))
            import_chunks.push_back(chunk);
        if (isOneOfTypes(type, textures))
            textures_chunks.push_back(chunk);
    }
    const std::byte mesh{1};
    for (uint32_t i = 0; i < pack.meshes.size(); ++i)
        import_chunks.push_back(plainChunk(kChunkSourceMesh, i, 1, std::span(&mesh, 1)));

    if (!pack.instance_meshes.empty())
        clusters_chunks.push_back(plainChunk(kChunkInstanceMeshes, 0, sizeof(uint32_t),
                                             std::as_bytes(std::span(pack.instance_meshes))));
    skinning_chunks.push_back(plainChunk(kChunkDeformedGroups, 0, sizeof(DeformedGroupRecord),
                                         std::as_bytes(std::span(pack.deformed_groups))));

    const std::string path = folder + "/" + prefix;
    writeFile(path + ".import.part", assemble(ContainerKind::part, import_chunks));
    writeFile(path + ".clusters.part", assemble(ContainerKind::part, clusters_chunks));
    writeFile(path + ".textures.part", assemble(ContainerKind::part, textures_chunks));
    writeFile(path + ".skinning.part", assemble(ContainerKind::part, skinning_chunks));
}

namespace
{

/// Write a part with the chunks of these types.
void writeChunks(const PackModel& pack, std::span<const uint32_t> types, const std::string& path)
{
    std::vector<ChunkImage> chunks;
    for (const ChunkImage& chunk : pack.chunks(true))
        if (std::ranges::find(types, chunk.entry.type) != types.end())
            chunks.push_back(chunk);
    writeFile(path, assemble(ContainerKind::part, chunks));
}

} // namespace

void writeSpecularPart(const PackModel& pack, const std::string& path)
{
    const ChunkImage chunks[] = {plainChunk(kChunkSpecular, 0, sizeof(SpecularTableRecord),
                                            std::as_bytes(std::span(pack.specular_tables)))};
    writeFile(path, assemble(ContainerKind::part, chunks));
}

void writeProbePart(const PackModel& pack, const std::string& path)
{
    const ChunkImage chunks[] = {
        plainChunk(kChunkProbes, 0, sizeof(ProbeRecord), std::as_bytes(std::span(pack.probes))),
        plainChunk(kChunkProbeTexels, 0, sizeof(uint32_t), std::as_bytes(std::span(pack.probe_texels)))};
    writeFile(path, assemble(ContainerKind::part, chunks));
}

void writeBricksPart(const PackModel& pack, const std::string& path)
{
    writeChunks(pack, kBrickChunks, path);
}

void writeReceiversPart(const PackModel& pack, const std::string& path)
{
    std::vector<uint32_t> chunks(kReceiverChunks.begin(), kReceiverChunks.end());
    chunks.insert(chunks.end(), kFaceReceiverChunks.begin(), kFaceReceiverChunks.end());
    writeChunks(pack, chunks, path);
}

void writePackFile(const PackModel& pack, const std::string& path)
{
    writeFile(path, pack.bytes());
}

} // namespace hearth::test
