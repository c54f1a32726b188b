// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/entropy_blocks.h"

#include "formats/assert.h"

#include <zstd.h>
#include <stdlib.h>
#include <stdio.h>

#include <cmath>
#include <memory>

namespace hearth::clusters
{

namespace
{

// Levels above look longer for matches, of which these streams have few.
constexpr int kZstdLevel = 1;

struct FreeContext
{
    void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
};

} // namespace

double bitsOf(const Histogram& histogram)
{
    // the code's table
    double bits = getenv("ZP") ? atof(getenv("ZP")) : 64;
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
    const auto succeeded = [](size_t result) { return ZSTD_isError(result) == 0; };
    HEARTH_ASSERT(
        succeeded(ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, kZstdLevel)) &&
        succeeded(ZSTD_CCtx_setPledgedSrcSize(context.get(), content_.size())));
    if (getenv("ZL")) ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, atoi(getenv("ZL")));
    if (getenv("ZM")) ZSTD_CCtx_setParameter(context.get(), ZSTD_c_minMatch, atoi(getenv("ZM")));
    if (getenv("ZT")) ZSTD_CCtx_setParameter(context.get(), ZSTD_c_targetLength, atoi(getenv("ZT")));
    if (getenv("ZC")) ZSTD_CCtx_setParameter(context.get(), ZSTD_c_experimentalParam5, atoi(getenv("ZC")));
    std::vector<std::byte> packed(ZSTD_compressBound(content_.size()) + 64 * block_ends_.size());
    ZSTD_outBuffer out{packed.data(), packed.size(), 0};
    ZSTD_inBuffer in{content_.data(), 0, 0};
    for (const size_t end : block_ends_)
    {
        in.size = end;
        const bool last = end == content_.size();
        const size_t rest =
            ZSTD_compressStream2(context.get(), &out, &in, last ? ZSTD_e_end : ZSTD_e_flush);
        HEARTH_ASSERT(rest == 0 && in.pos == end);
        if (getenv("ZD")) { static size_t prev_in, prev_out; if (end < prev_in) prev_in = prev_out = 0; Histogram h{}; for (size_t i = prev_in; i < end; ++i) ++h[content_[i]]; uint32_t d=0; for (auto c:h) d+=c>0; fprintf(stderr, "block %zu -> %zu  est %.0f  symbols %u\n", end - prev_in, out.pos - prev_out, bitsOf(h)/8, d); prev_in = end; prev_out = out.pos; if (last) fprintf(stderr,"--\n"), prev_in=prev_out=0;}
    }
    packed.resize(out.pos);
    return packed;
}

} // namespace hearth::clusters
