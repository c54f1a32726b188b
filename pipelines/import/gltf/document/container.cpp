// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf/document/container.h"

#include "formats/base/byte_reader.h"
#include "formats/records/container.h"

#include <fmt/format.h>

namespace hearth::import
{

namespace
{

constexpr uint32_t kGlbMagic = formats::fourCC("glTF");
constexpr uint32_t kGlbVersion = 2;
constexpr uint32_t kChunkJson = formats::fourCC("JSON");
constexpr uint32_t kChunkBinary = 0x004E4942; // "BIN" and a zero byte

struct GlbHeader
{
    uint32_t magic;
    uint32_t version;
    uint32_t length;
};

struct GlbChunk
{
    uint32_t length;
    uint32_t type;
};

std::string_view asText(std::span<const std::byte> bytes)
{
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Remove zero padding: writers that pad with zeros instead of spaces are common enough to be tolerated.
std::string_view trimPadding(std::string_view json)
{
    while (json.ends_with('\0'))
        json.remove_suffix(1);
    return json;
}

Result<GltfContainer> splitGlb(std::span<const std::byte> bytes, const std::string& file)
{
    const auto damaged = [&](std::string detail) {
        return Error{Issue::glb_structure, file, "", std::move(detail)};
    };
    const auto header = ByteReader(bytes).read<GlbHeader>();
    if (!header)
        return damaged("the file ends inside the GLB header");
    if (header->version != kGlbVersion)
        return Error{Issue::gltf_version, file, "",
                     fmt::format("the GLB container has version {}", header->version)};
    if (header->length > bytes.size())
        return damaged(fmt::format("the file has {} bytes, but says {}", bytes.size(), header->length));

    // bytes after the stated length are not part of the file
    ByteReader reader(bytes.first(header->length));
    if (!reader.skip(sizeof(GlbHeader)))
        return damaged(fmt::format("the file says that it has {} bytes", header->length));
    GltfContainer container;
    for (size_t chunk = 0; reader.remaining() > 0; ++chunk)
    {
        const auto chunk_header = reader.read<GlbChunk>();
        const auto content = chunk_header ? reader.readBytes(chunk_header->length) : std::nullopt;
        if (!content)
            return damaged(fmt::format("chunk {} goes beyond the end of the file", chunk));
        if ((chunk == 0) != (chunk_header->type == kChunkJson))
            return damaged(chunk == 0 ? "the first chunk is not JSON" : "there are two JSON chunks");
        if (chunk == 0)
            container.json = trimPadding(asText(*content));
        else if (chunk == 1 && chunk_header->type == kChunkBinary)
            container.binary = *content;
    }
    if (container.json.empty())
        return damaged("there is no JSON");
    return container;
}

} // namespace

Result<GltfContainer> splitGltf(std::span<const std::byte> bytes, const std::string& file)
{
    const auto magic = ByteReader(bytes).read<uint32_t>();
    if (magic == kGlbMagic)
        return splitGlb(bytes, file);
    return GltfContainer{asText(bytes), std::nullopt};
}

} // namespace hearth::import
