// Source: Draco 3D Graphics Compression, "Draco Bitstream Specification", sections on header, metadata and
// connectivity; older bitstreams as in the library.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/source/draco_counts.h"

#include <draco/compression/point_cloud/point_cloud_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>

#include <algorithm>
#include <cstdint>

namespace hearth::import
{

namespace
{

// Limit of the compression ratio. Entropy coding leaves about a thousandth of a byte for each point of a
// flat, regular grid, the densest data. A claim of a few points is always allowed.
constexpr uint64_t kMaxCountPerByte = 4096;
constexpr uint64_t kMinRefusedCount = 4096;

constexpr uint16_t kVersionWithVarints = 0x0202; ///< of meshes; Edgebreaker has them from 2.0 on
constexpr uint16_t kEdgebreakerVersionWithVarints = 0x0200;

std::optional<uint32_t> readCount(draco::DecoderBuffer& buffer, bool is_varint)
{
    uint32_t count = 0;
    const bool is_read = is_varint ? draco::DecodeVarint(&count, &buffer) : buffer.Decode(&count);
    return is_read ? std::optional(count) : std::nullopt;
}

/// Return the largest of the counts before the connectivity; 0 if they cannot be read.
uint64_t readLargestCount(draco::DecoderBuffer& buffer, const draco::DracoHeader& header)
{
    const auto version = static_cast<uint16_t>(header.version_major << 8 | header.version_minor);
    if (header.encoder_type == draco::POINT_CLOUD)
        return readCount(buffer, false).value_or(0);
    bool is_varint = version >= kVersionWithVarints;
    size_t counts = 2; // faces and points
    if (header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING)
    {
        uint8_t traversal = 0;
        if (!buffer.Decode(&traversal))
            return 0;
        is_varint = version >= kEdgebreakerVersionWithVarints;
        counts = version < kVersionWithVarints ? 3 : 2; // new vertices, vertices and faces
    }
    uint64_t largest = 0;
    for (size_t i = 0; i < counts; ++i)
        largest = std::max<uint64_t>(largest, readCount(buffer, is_varint).value_or(0));
    return largest;
}

} // namespace

std::optional<std::string> findImpossibleDracoCount(std::span<const std::byte> bytes)
{
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    draco::DracoHeader header;
    if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok())
        return std::nullopt;
    buffer.set_bitstream_version(static_cast<uint16_t>(header.version_major << 8 | header.version_minor));
    draco::GeometryMetadata metadata;
    if ((header.flags & METADATA_FLAG_MASK) != 0 &&
        !draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &metadata))
        return std::nullopt;
    const uint64_t count = readLargestCount(buffer, header);
    if (count <= kMinRefusedCount || count / kMaxCountPerByte <= bytes.size())
        return std::nullopt;
    return std::to_string(count) + " points or faces cannot come from " + std::to_string(bytes.size()) +
           " bytes";
}

} // namespace hearth::import
