// Streams of bytes as one zstd frame, cut into blocks so that streams that differ have codes of their own.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hearth::clusters
{

using Histogram = std::array<uint32_t, 256>;

/// About the bits that bytes with this histogram take in a block of their own.
double bitsOf(const Histogram& histogram);

class EntropyBlocks
{
public:
    /// Append a stream: to the last block if their codes are cheaper together than apart.
    void add(std::span<const uint8_t> stream);

    /// One frame that names its content's size; the content is all streams, one behind the other.
    std::vector<std::byte> compress() const;

private:
    std::vector<uint8_t> content_;
    std::vector<size_t> block_ends_;
    Histogram histogram_{}; ///< of the last block
    double bits_ = 0;       ///< that it takes
};

} // namespace hearth::clusters
