// Writes the chunk of an image's texels in pieces, and finds them again.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/container/container_writer.h"
#include "formats/pack/pack_view.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hearth::formats
{

/// Add the chunk of an image's texels, each piece as a frame of its own.
/// mips  all, finest first, of the record's size
Status addImageData(ContainerWriter& writer, uint32_t index, const ImageRecord& image,
                    std::span<const std::byte> mips);

/// Return the records of the pieces of an image; none if its chunk is not in frames.
/// errors: chunk_missing; chunk_codec if the frames are not the pieces.
Result<std::vector<TexturePieceRecord>> readPieces(const PackView& part, uint32_t image);

} // namespace hearth::formats
