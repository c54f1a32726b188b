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

void encodeMip(Content content, uint32_t format, const FloatImage& mip, float alpha_scale,
               std::span<std::byte> out)
{
    const size_t row_bytes = out.size() / mip.height;
    tbb::parallel_for(tbb::blocked_range<uint32_t>(0, mip.height),
                      [&](const tbb::blocked_range<uint32_t>& rows)
                      {
                          for (uint32_t y = rows.begin(); y < rows.end(); ++y)
                              encodeRow(content, format, mip.row(y), alpha_scale,
                                        out.subspan(y * row_bytes, row_bytes));
                      });
}

/// Make the normals of the finest mip unit. Maps that were resized or compressed have lengths of .85 to 1.15,
/// and x and y alone, which is what shaders read, would then be off by degrees.
void makeUnit(const ImageRecord& image, std::span<std::byte> texels)
{
    const size_t row_bytes = texels.size() / image.height;
    tbb::parallel_for(tbb::blocked_range<uint32_t>(0, image.height),
                      [&](const tbb::blocked_range<uint32_t>& rows)
                      {
                          std::vector<Float4> normals(image.width);
                          for (uint32_t y = rows.begin(); y < rows.end(); ++y)
                          {
                              const std::span<std::byte> row = texels.subspan(y * row_bytes, row_bytes);
                              decodeRow(Content::normals, image.format, row, normals);
                              encodeRow(Content::normals, image.format, normals, 1, row);
                          }
                      });
}

/// True if mips must keep the share of texels that pass the alpha test.
bool keepsCoverage(const ImageRecord& image)
{
    return (image.flags & formats::kImageAlphaTested) != 0 && formats::texelBytes(image.format) == 4;
}

} // namespace

uint32_t fullMipCount(uint32_t width, uint32_t height)
{
    return static_cast<uint32_t>(std::bit_width(std::max(width, height)));
}

std::vector<std::byte> buildMipChain(const ImageRecord& image, std::vector<std::byte> texels,
                                     uint32_t max_bits, RoughnessFilter* filter)
{
    ImageRecord chain = image;
    chain.format = mipFormat(image.format, max_bits);
    chain.mip_count = fullMipCount(image.width, image.height);
    HEARTH_ASSERT(texels.size() == formats::mipOffset(image, 1));
    const Content content = classifyContent(image);
    const size_t row_bytes = texels.size() / image.height;
    const bool is_narrowed = chain.format != image.format;
    std::vector<std::byte> mips = is_narrowed ? formats::narrowTexels(texels) : std::move(texels);
    const double coverage = keepsCoverage(chain) ? alphaCoverage(mips, image.alpha_cutoff) : 0;
    if (content == Content::normals)
        makeUnit(chain, mips);
    mips.resize(static_cast<size_t>(formats::mipOffset(chain, chain.mip_count)));
    const std::span<const std::byte> source = is_narrowed ? texels : mips;

    FloatImage mip;
    for (uint32_t level = 1; level < chain.mip_count; ++level)
    {
        // the first mip is made from stored texels row by row: as floats, the finest mip would be four times
        // as large
        const auto readStored = [&](uint32_t y, std::span<Float4> out)
        { decodeRow(content, image.format, source.subspan(y * row_bytes, row_bytes), out); };
        const auto readMip = [&](uint32_t y, std::span<Float4> out)
        { std::copy(mip.row(y).begin(), mip.row(y).end(), out.begin()); };
        mip =
            level == 1 ? halve(image.width, image.height, readStored) : halve(mip.width, mip.height, readMip);

        const float alpha_scale =
            keepsCoverage(chain) ? scaleForCoverage(mip, image.alpha_cutoff, coverage) : 1;
        const auto begin = static_cast<size_t>(formats::mipOffset(chain, level));
        const auto end = static_cast<size_t>(formats::mipOffset(chain, level + 1));
        const std::span<std::byte> out = std::span(mips).subspan(begin, end - begin);
        if (filter == nullptr)
        {
            encodeMip(content, chain.format, mip, alpha_scale, out);
            continue;
        }
        FloatImage widened = mip; // the next mip is made from what this one was before
        filter->apply(widened);
        encodeMip(content, chain.format, widened, alpha_scale, out);
    }
    return mips;
}

} // namespace hearth::textures
