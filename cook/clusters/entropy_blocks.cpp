// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/entropy_blocks.h"

#include "formats/assert.h"

// for the literal compression mode: else zstd does not code literals where it does not look for matches
#define ZSTD_STATIC_LINKING_ONLY
#include <zstd.h>

#include <cmath>
#include <memory>

namespace hearth::clusters
{

namespace
{

// Streams of differences have no matches worth their decoding: literals alone decode 1.5 times as fast.
constexpr int kZstdLevel = 1;
constexpr int kNoMatches = ZSTD_TARGETLENGTH_MAX; ///< how soon the search gives up

/// What a block costs that has nothing in it: its decoder sets up a code first, in the time of so many bits.
constexpr double kBitsOfBlock = 1000;

struct FreeContext
{
    void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
};

} // namespace

double bitsOf(const Histogram& histogram)
{
    double bits = kBitsOfBlock;
    uint32_t total = 0;
    for (const uint32_t count : histogram)
    {
        if (count == 0)
            continue;
        total += count;
        bits += 3 - count * std::log2(static_cast<double>(count));
    }
    return total == 0 ? 0 : bits + total * std::log2(static_cast<double>(total));
}

void EntropyBlocks::add(std::span<const uint8_t> stream)
{
    if (stream.empty())
        return;
    Histogram own{};
    for (const uint8_t byte : stream)
        ++own[byte];
    Histogram both = own;
    for (size_t i = 0; i < both.size(); ++i)
        both[i] += histogram_[i];
    const double own_bits = bitsOf(own);
    const double both_bits = bitsOf(both);
    const bool together = !block_ends_.empty() && both_bits <= bits_ + own_bits;
    if (together)
        block_ends_.pop_back();
    histogram_ = together ? both : own;
    bits_ = together ? both_bits : own_bits;
    content_.insert(content_.end(), stream.begin(), stream.end());
    block_ends_.push_back(content_.size());
}

std::vector<std::byte> EntropyBlocks::compress() const
{
    const std::unique_ptr<ZSTD_CCtx, FreeContext> context(ZSTD_createCCtx());
    HEARTH_ASSERT(context != nullptr);
    const auto set = [&](ZSTD_cParameter parameter, int value)
    { return ZSTD_isError(ZSTD_CCtx_setParameter(context.get(), parameter, value)) == 0; };
    HEARTH_ASSERT(set(ZSTD_c_compressionLevel, kZstdLevel) && set(ZSTD_c_targetLength, kNoMatches) &&
                  set(ZSTD_c_literalCompressionMode, ZSTD_ps_enable) &&
                  ZSTD_isError(ZSTD_CCtx_setPledgedSrcSize(context.get(), content_.size())) == 0);
    std::vector<std::byte> packed(ZSTD_compressBound(content_.size()) + 64 * block_ends_.size());
    ZSTD_outBuffer out{packed.data(), packed.size(), 0};
    ZSTD_inBuffer in{content_.data(), 0, 0};
    for (const size_t end : block_ends_)
    {
        in.size = end;
        const bool last = end == content_.size();
        const size_t rest = ZSTD_compressStream2(context.get(), &out, &in, last ? ZSTD_e_end : ZSTD_e_flush);
        HEARTH_ASSERT(rest == 0 && in.pos == end);
    }
    packed.resize(out.pos);
    return packed;
}

} // namespace hearth::clusters
