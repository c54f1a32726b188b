// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/piece_decoder.h"

#include "runtime/pack/decoded_texels.h"

#include <utility>

namespace hearth::pack
{

std::span<std::byte> PieceDecoder::begin(uint32_t image, uint32_t number, const formats::TexturePiece& piece,
                                         std::span<std::byte> destination)
{
    jobs_[number] = {image, piece, destination, std::vector<std::byte>(piece.size)};
    return jobs_[number].stored;
}

void PieceDecoder::finish(uint32_t number)
{
    const Job job = std::exchange(jobs_[number], {});
    if (!job.stored.empty())
        decodeTexels(view_->images()[job.image], job.piece, job.stored, job.destination);
}

} // namespace hearth::pack
