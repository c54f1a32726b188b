// Streams of bytes as one zstd frame, cut into blocks so that streams that differ have codes of their own, and behind it
// those that no code makes much shorter.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

struct ZSTD_CCtx_s;

namespace hearth::pages
{

using Histogram = std::array<uint32_t, 256>;

Histogram histogramOf(std::span<const uint8_t> bytes);

/// count * log2(count); 0 for 0.
double timesLog2(uint32_t count);

/// About the bits that bytes with this histogram take, and the time of bits that it takes to decode them: coded, or as
/// they are.
double storedBits(const Histogram& histogram);

/// One page's streams after the other's.
class EntropyBlocks
{
public:
    EntropyBlocks();

    void clear();

    /// Append a stream. Its bytes must stay until compress().
    void add(std::span<const uint8_t> stream);

    /// A frame that names its content's size, and what stands behind it: their content is all streams, one behind the
    /// other.
    std::vector<std::byte> compress();

private:
    struct FreeContext
    {
        void operator()(ZSTD_CCtx_s* context) const;
    };

    void addCoded(std::span<const uint8_t> stream, const Histogram& histogram);

    std::unique_ptr<ZSTD_CCtx_s, FreeContext> context_;
    std::vector<std::span<const uint8_t>> streams_;
    std::vector<Histogram> histograms_; ///< of each stream
    std::vector<uint8_t> content_;      ///< that is coded
    std::vector<size_t> block_ends_;
    Histogram histogram_{}; ///< of the last block
    double bits_ = 0;       ///< that it takes
};

} // namespace hearth::pages
