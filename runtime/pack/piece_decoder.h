// Decodes pieces of images whose formats the device lacks, on the threads that read them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/texture_pieces.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hearth::pack
{

/// Buffers between reads of pieces and staging memory. A piece is touched by one thread at a time: by begin,
/// then by the reader, then by finish.
class PieceDecoder
{
public:
    /// view  of a checked pack that outlives the decoder
    explicit PieceDecoder(const formats::PackView& view) : view_(&view), jobs_(view.texturePieces().size()) {}

    /// Return a buffer to read a piece into.
    /// image        of the piece
    /// number       of the piece in the pack
    /// piece        the same of its image
    /// destination  decodedBytes of it
    std::span<std::byte> begin(uint32_t image, uint32_t number, const formats::TexturePiece& piece,
                               std::span<std::byte> destination);

    /// Decode a piece that has been read, from any thread. Nothing happens to a piece that was not begun.
    void finish(uint32_t number);

private:
    struct Job
    {
        uint32_t image = 0;
        formats::TexturePiece piece{};
        std::span<std::byte> destination{};
        std::vector<std::byte> stored{}; ///< empty: not begun
    };

    const formats::PackView* view_;
    std::vector<Job> jobs_; ///< by number of the piece
};

} // namespace hearth::pack
