// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/textures/mip_chain.h"

#include "cook/textures/alpha_coverage.h"
#include "cook/textures/halve.h"
#include "cook/textures/texel_codec.h"
#include "formats/base/assert.h"
#include "formats/pack/pack_view.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>

namespace hearth::textures
{

namespace
{

using formats::ImageRecord;

void encodeMip(Content content, const FloatImage& mip, float alpha_scale, std::span<std::byte> out)
{
    const size_t row_bytes = out.size() / mip.height;
    tbb::parallel_for(tbb::blocked_range<uint32_t>(0, mip.height),
                      [&](const tbb::blocked_range<uint32_t>& rows)
                      {
                          for (uint32_t y = rows.begin(); y < rows.end(); ++y)
                              encodeRow(content, mip.row(y), alpha_scale,
                                        out.subspan(y * row_bytes, row_bytes));
                      });
}

/// True if mips must keep the share of texels that pass the alpha test.
bool keepsCoverage(const ImageRecord& image)
{
    return (image.flags & formats::kImageAlphaTested) != 0 &&
           static_cast<formats::TexelFormat>(image.format) != formats::TexelFormat::rgba16_float;
}

} // namespace

uint32_t fullMipCount(uint32_t width, uint32_t height)
{
    return static_cast<uint32_t>(std::bit_width(std::max(width, height)));
}

std::vector<std::byte> buildMipChain(const ImageRecord& image, std::vector<std::byte> texels)
{
    ImageRecord chain = image;
    chain.mip_count = fullMipCount(image.width, image.height);
    HEARTH_ASSERT(texels.size() == formats::mipOffset(chain, 1));
    const Content content = classifyContent(image);
    const size_t row_bytes = texels.size() / image.height;
    const double coverage = keepsCoverage(image) ? alphaCoverage(texels, image.alpha_cutoff) : 0;
    texels.resize(static_cast<size_t>(formats::mipOffset(chain, chain.mip_count)));

    FloatImage mip;
    for (uint32_t level = 1; level < chain.mip_count; ++level)
    {
        // the first mip is made from stored texels row by row: as floats, the finest mip would be four times
        // as large
        const auto readStored = [&](uint32_t y, std::span<Float4> out)
        { decodeRow(content, std::span(texels).subspan(y * row_bytes, row_bytes), out); };
        const auto readMip = [&](uint32_t y, std::span<Float4> out)
        { std::copy(mip.row(y).begin(), mip.row(y).end(), out.begin()); };
        mip =
            level == 1 ? halve(image.width, image.height, readStored) : halve(mip.width, mip.height, readMip);

        const float alpha_scale =
            keepsCoverage(image) ? scaleForCoverage(mip, image.alpha_cutoff, coverage) : 1;
        const auto begin = static_cast<size_t>(formats::mipOffset(chain, level));
        const auto end = static_cast<size_t>(formats::mipOffset(chain, level + 1));
        encodeMip(content, mip, alpha_scale, std::span(texels).subspan(begin, end - begin));
    }
    return texels;
}

} // namespace hearth::textures
