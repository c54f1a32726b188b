// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/pages/entropy_blocks.h"

#include "formats/base/assert.h"

// for the literal compression mode: without it zstd does not code literals where it does not search for
// matches
#define ZSTD_STATIC_LINKING_ONLY
#include <zstd.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace hearth::pages
{

namespace
{

// Streams of differences have no matches worth their decoding time: literals alone decode 1.5 times as fast.
constexpr int kZstdLevel = 1;
constexpr int kNoMatches = ZSTD_TARGETLENGTH_MAX; ///< step at which the search gives up

// Smallest table for matches: it is cleared for each page.
constexpr int kHashLog = ZSTD_HASHLOG_MIN;

/// Cost of an empty block in bits: its decoder first sets up a code.
constexpr double kBitsOfBlock = 2000;

/// Cost of a coded byte besides its bits, for its decoding time: 2.5 takes 2 % more bytes than 0.25, and zstd
/// a third less time (`./dev bench clusters`, rock2m).
constexpr double kBitsOfCodedByte = 2.5;

/// Table of timesLog2 for small counts: logarithms are slow.
const std::array<float, 1024> kSmallCounts = []
{
    std::array<float, 1024> values{};
    for (uint32_t i = 2; i < values.size(); ++i)
        values[i] = static_cast<float>(i * std::log2(static_cast<double>(i)));
    return values;
}();

/// Estimate the bits of the coded bytes and of their code table.
double codedBits(const Histogram& histogram)
{
    double bits = 0;
    uint32_t total = 0;
    for (const uint32_t count : histogram)
    {
        if (count == 0)
            continue;
        total += count;
        bits += 3 - timesLog2(count);
    }
    return total == 0 ? 0 : bits + timesLog2(total);
}

uint32_t totalCount(const Histogram& histogram)
{
    uint32_t total = 0;
    for (const uint32_t count : histogram)
        total += count;
    return total;
}

} // namespace

Histogram computeHistogram(std::span<const uint8_t> bytes)
{
    Histogram histogram{};
    for (const uint8_t byte : bytes)
        ++histogram[byte];
    return histogram;
}

double timesLog2(uint32_t count)
{
    return count < kSmallCounts.size() ? double{kSmallCounts[count]}
                                       : count * std::log2(static_cast<double>(count));
}

double storedBits(const Histogram& histogram)
{
    const double total = totalCount(histogram);
    return std::min(8 * total, codedBits(histogram) + kBitsOfCodedByte * total);
}

void EntropyBlocks::FreeContext::operator()(ZSTD_CCtx_s* context) const
{
    ZSTD_freeCCtx(context);
}

EntropyBlocks::EntropyBlocks() : context_(ZSTD_createCCtx())
{
    HEARTH_ASSERT(context_ != nullptr);
    const auto set = [&](ZSTD_cParameter parameter, int value)
    { return ZSTD_isError(ZSTD_CCtx_setParameter(context_.get(), parameter, value)) == 0; };
    HEARTH_ASSERT(set(ZSTD_c_compressionLevel, kZstdLevel) && set(ZSTD_c_targetLength, kNoMatches) &&
                  set(ZSTD_c_hashLog, kHashLog) && set(ZSTD_c_literalCompressionMode, ZSTD_ps_enable));
}

void EntropyBlocks::clear()
{
    streams_.clear();
    histograms_.clear();
    content_.clear();
    block_ends_.clear();
}

void EntropyBlocks::add(std::span<const uint8_t> stream)
{
    if (stream.empty())
        return;
    streams_.push_back(stream);
    histograms_.push_back(computeHistogram(stream));
}

/// Append to the last block if a shared code is cheaper than two.
void EntropyBlocks::addCoded(std::span<const uint8_t> stream, const Histogram& histogram)
{
    Histogram both = histogram;
    for (size_t i = 0; i < both.size(); ++i)
        both[i] += histogram_[i];
    const double own_bits = codedBits(histogram) + kBitsOfBlock;
    const double both_bits = codedBits(both) + kBitsOfBlock;
    const bool together = !block_ends_.empty() && both_bits <= bits_ + own_bits;
    if (together)
        block_ends_.pop_back();
    histogram_ = together ? both : histogram;
    bits_ = together ? both_bits : own_bits;
    content_.insert(content_.end(), stream.begin(), stream.end());
    block_ends_.push_back(content_.size());
}

std::vector<std::byte> EntropyBlocks::compress()
{
    size_t coded = streams_.size();
    size_t rest = 0;
    while (coded > 1 &&
           storedBits(histograms_[coded - 1]) >= 8.0 * static_cast<double>(streams_[coded - 1].size()))
        rest += streams_[--coded].size();
    for (size_t i = 0; i < coded; ++i)
        addCoded(streams_[i], histograms_[i]);
    ZSTD_CCtx_reset(context_.get(), ZSTD_reset_session_only);
    HEARTH_ASSERT(ZSTD_isError(ZSTD_CCtx_setPledgedSrcSize(context_.get(), content_.size())) == 0);
    std::vector<std::byte> packed(ZSTD_compressBound(content_.size()) + 64 * block_ends_.size() + rest);
    ZSTD_outBuffer out{packed.data(), packed.size(), 0};
    ZSTD_inBuffer in{content_.data(), 0, 0};
    for (const size_t end : block_ends_)
    {
        in.size = end;
        const bool last = end == content_.size();
        const size_t left = ZSTD_compressStream2(context_.get(), &out, &in, last ? ZSTD_e_end : ZSTD_e_flush);
        HEARTH_ASSERT(left == 0 && in.pos == end);
    }
    for (size_t i = coded; i < streams_.size(); ++i)
    {
        std::memcpy(packed.data() + out.pos, streams_[i].data(), streams_[i].size());
        out.pos += streams_[i].size();
    }
    packed.resize(out.pos);
    return packed;
}

} // namespace hearth::pages
