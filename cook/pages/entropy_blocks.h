// Compresses streams of bytes as one zstd frame, cut into blocks so that dissimilar streams have separate
// codes. Streams that no code shortens much follow uncompressed.
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

Histogram computeHistogram(std::span<const uint8_t> bytes);

/// Return count * log2(count); 0 for 0.
double timesLog2(uint32_t count);

/// Estimate the cost of bytes with this histogram, coded or raw: their bits, plus the decoding time expressed
/// in bits.
double storedBits(const Histogram& histogram);

/// Compresses the streams of one page after the other.
class EntropyBlocks
{
public:
    EntropyBlocks();

    void clear();

    /// Append a stream. Its bytes must stay until compress().
    void add(std::span<const uint8_t> stream);

    /// Return a frame that states its content size, and the raw bytes behind it: together they contain all
    /// streams in order.
    std::vector<std::byte> compress();

private:
    struct FreeContext
    {
        void operator()(ZSTD_CCtx_s* context) const;
    };

    void addCoded(std::span<const uint8_t> stream, const Histogram& histogram);

    std::unique_ptr<ZSTD_CCtx_s, FreeContext> context_;
    std::vector<std::span<const uint8_t>> streams_;
    std::vector<Histogram> histograms_; ///< one for each stream
    std::vector<uint8_t> content_;      ///< content to be coded
    std::vector<size_t> block_ends_;
    Histogram histogram_{}; ///< of the last block
    double bits_ = 0;       ///< bits of the last block
};

} // namespace hearth::pages
