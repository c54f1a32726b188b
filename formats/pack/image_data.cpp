// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/pack/image_data.h"

#include "formats/pack/texture_pieces.h"

#include <zstd.h>

namespace hearth::formats
{

Status addImageData(ContainerWriter& writer, uint32_t index, const ImageRecord& image,
                    std::span<const std::byte> mips)
{
    std::vector<uint32_t> sizes;
    for (const TexturePiece& piece : listTexturePieces(image))
        sizes.push_back(piece.size);
    return writer.addFrames(
        {.type = kChunkImageData, .index = index, .version = chunkVersion(kChunkImageData)}, mips, sizes);
}

Result<std::vector<TexturePieceRecord>> readPieces(const PackView& part, uint32_t image)
{
    const std::string where = chunkName(kChunkImageData, image);
    const ChunkEntry* const entry = part.container().find(kChunkImageData, image);
    if (entry == nullptr)
        return Error{Issue::chunk_missing, part.name(), where, ""};
    std::vector<TexturePieceRecord> records;
    if (entry->codec != static_cast<uint32_t>(Codec::zstd_frames))
        return records;
    const std::span<const std::byte> stored = part.container().stored(*entry);
    uint64_t offset = 0;
    for (const TexturePiece& piece : listTexturePieces(part.images()[image]))
    {
        const std::span<const std::byte> rest = stored.subspan(static_cast<size_t>(offset));
        const size_t size = ZSTD_findFrameCompressedSize(rest.data(), rest.size());
        if (ZSTD_isError(size) || !isSingleFrame(rest.first(size), piece.size))
            return Error{Issue::chunk_codec, part.name(), where, "its frames are not the image's pieces"};
        records.push_back({.offset = offset,
                           .stored_size = static_cast<uint32_t>(size),
                           .size = piece.size,
                           .hash = hashBytes(rest.first(size))});
        offset += size;
    }
    return records;
}

} // namespace hearth::formats
