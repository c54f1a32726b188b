// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/textures/fill_colors.h"

#include "cook/textures/halve.h"
#include "cook/textures/texel_codec.h"
#include "formats/base/assert.h"
#include "formats/pack/image_uses.h"
#include "formats/pack/pack_view.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace hearth::textures
{

using namespace formats;

namespace
{

/// Run a function for each row.
template <typename Function>
void forRows(uint32_t height, const Function& function)
{
    tbb::parallel_for(tbb::blocked_range<uint32_t>(0, height),
                      [&](const tbb::blocked_range<uint32_t>& rows)
                      {
                          for (uint32_t y = rows.begin(); y < rows.end(); ++y)
                              function(y);
                      });
}

/// Two texels of a line of a smaller image around the centre of a texel of the larger one.
struct Neighbours
{
    uint32_t first, second;
    float weight; ///< of the second
};

Neighbours findNeighbours(uint32_t texel, uint32_t size, uint32_t smaller_size)
{
    const float at = std::max((static_cast<float>(texel) + 0.5f) * static_cast<float>(smaller_size) /
                                      static_cast<float>(size) -
                                  0.5f,
                              0.0f);
    const auto first = std::min(static_cast<uint32_t>(at), smaller_size - 1);
    return {first, std::min(first + 1, smaller_size - 1), at - std::floor(at)};
}

Float4 blend(const Float4& a, const Float4& b, float weight)
{
    const float rest = 1 - weight;
    return {a.x * rest + b.x * weight, a.y * rest + b.y * weight, a.z * rest + b.z * weight,
            a.w * rest + b.w * weight};
}

/// Return the colour of a smaller image at the centre of a texel of a larger one.
Float4 interpolate(const FloatImage& smaller, const Neighbours& column, const Neighbours& line)
{
    const auto across = [&](uint32_t y)
    { return blend(smaller.row(y)[column.first], smaller.row(y)[column.second], column.weight); };
    return blend(across(line.first), across(line.second), line.weight);
}

/// Return the mean of the known colours among the eight texels around one, weighted by alpha; w is 0 where
/// there are none.
/// read  returns the plain colour of a texel, and its alpha; 0 if it is not known
template <typename Read>
Float4 averageAround(uint32_t width, uint32_t height, uint32_t x, uint32_t y, const Read& read)
{
    Float4 sum;
    for (uint32_t row = y - std::min(y, 1u); row <= std::min(y + 1, height - 1); ++row)
        for (uint32_t column = x - std::min(x, 1u); column <= std::min(x + 1, width - 1); ++column)
        {
            const Float4 texel = read(column, row);
            sum = {sum.x + texel.x * texel.w, sum.y + texel.y * texel.w, sum.z + texel.z * texel.w,
                   sum.w + texel.w};
        }
    const float weight = sum.w > 0 ? sum.w : 1;
    return {sum.x / weight, sum.y / weight, sum.z / weight, sum.w};
}

/// Fill the unknown texels of a mip: from known texels beside them, so that no other colour reaches an edge,
/// else from the next smaller mip, which is full. Filled texels keep their alpha of 0.
void fillMip(const FloatImage& smaller, FloatImage& mip)
{
    const auto read = [&](uint32_t x, uint32_t y)
    {
        const Float4& texel = std::as_const(mip).row(y)[x];
        return texel.w > 0 ? texel : Float4{};
    };
    std::vector<Float4> filled(mip.texels.size());
    forRows(mip.height,
            [&](uint32_t y)
            {
                const Neighbours line = findNeighbours(y, mip.height, smaller.height);
                for (uint32_t x = 0; x < mip.width; ++x)
                {
                    Float4& texel = filled[size_t{y} * mip.width + x];
                    texel = read(x, y);
                    if (texel.w > 0)
                        continue;
                    texel = averageAround(mip.width, mip.height, x, y, read);
                    if (texel.w == 0)
                        texel = interpolate(smaller, findNeighbours(x, mip.width, smaller.width), line);
                    texel.w = 0;
                }
            });
    mip.texels = std::move(filled);
}

/// Divide the colours of a mip by their weight: texels become plain colours, and w tells which are known.
void divideByWeight(FloatImage& mip)
{
    forRows(mip.height,
            [&](uint32_t y)
            {
                for (Float4& texel : mip.row(y))
                {
                    const float weight = texel.w > 0 ? texel.w : 1;
                    texel = {texel.x / weight, texel.y / weight, texel.z / weight, texel.w};
                }
            });
}

/// Return true if the alpha of a texel is 0.
bool isHidden(std::span<const std::byte> texel)
{
    return std::ranges::all_of(texel.last(texel.size() / 4), [](std::byte b) { return b == std::byte{0}; });
}

/// Write a colour with 8 bits a channel into a stored texel, and leave its alpha.
void writeColor(const Float4& color, std::span<std::byte> texel)
{
    std::array<std::byte, 4> stored;
    encodeRow(Content::color, static_cast<uint32_t>(TexelFormat::rgba8_srgb), {&color, 1}, 1, stored);
    const size_t channel_bytes = texel.size() / 4; // two equal bytes are the same share of the range as one
    for (size_t i = 0; i < 3 * channel_bytes; ++i)
        texel[i] = stored[i / channel_bytes];
}

} // namespace

std::vector<bool> listHiddenColors(std::span<const MaterialRecord> materials,
                                   std::span<const MaterialLayersRecord> layers, size_t image_count)
{
    const auto hides = [&](const ImageUse& use)
    {
        const MaterialRecord& material = materials[use.material];
        const auto mode = static_cast<AlphaMode>(material.alpha_mode);
        return use.role == "baseColor" &&
               (mode == AlphaMode::blend || (mode == AlphaMode::mask && material.alpha_cutoff > 0));
    };
    const std::vector<std::vector<ImageUse>> uses = imageUses(materials, layers, image_count);
    std::vector<bool> are_hidden(image_count);
    for (size_t image = 0; image < image_count; ++image)
        are_hidden[image] = !uses[image].empty() && std::ranges::all_of(uses[image], hides);
    return are_hidden;
}

void fillHiddenColors(const ImageRecord& image, std::span<std::byte> texels)
{
    HEARTH_ASSERT(isSrgb(image.format) && texels.size() == mipOffset(image, 1));
    const size_t texel_bytes = texelBytes(image.format), row_bytes = image.width * texel_bytes;
    size_t hidden = 0;
    for (size_t at = 0; at < texels.size(); at += texel_bytes)
        hidden += isHidden(texels.subspan(at, texel_bytes)) ? 1u : 0u;
    if (hidden == 0 || hidden * texel_bytes == texels.size())
        return;

    // pull: mips of the colours that are seen, weighted by alpha
    const auto readStored = [&](uint32_t y, std::span<Float4> out)
    {
        decodeRow(Content::color, image.format, texels.subspan(y * row_bytes, row_bytes), out);
        for (Float4& texel : out)
            texel = texel.w > 0 ? texel : Float4{};
    };
    std::vector<FloatImage> mips{halve(image.width, image.height, readStored)};
    while (mips.back().texels.size() > 1)
    {
        const FloatImage& last = mips.back();
        mips.push_back(halve(last.width, last.height,
                             [&](uint32_t y, std::span<Float4> out)
                             { std::ranges::copy(last.row(y), out.begin()); }));
    }
    // push: what is unknown in a mip is what the smaller mip shows there
    for (FloatImage& mip : mips)
        divideByWeight(mip);
    for (size_t mip = mips.size() - 1; mip-- > 0;)
        fillMip(mips[mip + 1], mips[mip]);
    const auto findTexel = [&](uint32_t x, uint32_t y)
    { return texels.subspan(y * row_bytes + x * texel_bytes, texel_bytes); };
    const auto read = [&](uint32_t x, uint32_t y)
    {
        Float4 color;
        if (const std::span<const std::byte> texel = findTexel(x, y); !isHidden(texel))
        {
            decodeRow(Content::color, image.format, texel, {&color, 1});
            color = {color.x / color.w, color.y / color.w, color.z / color.w, color.w};
        }
        return color;
    };
    forRows(image.height,
            [&](uint32_t y)
            {
                const Neighbours line = findNeighbours(y, image.height, mips[0].height);
                for (uint32_t x = 0; x < image.width; ++x)
                {
                    const std::span<std::byte> texel = findTexel(x, y);
                    if (!isHidden(texel))
                        continue;
                    Float4 color = averageAround(image.width, image.height, x, y, read);
                    if (color.w == 0)
                        color = interpolate(mips[0], findNeighbours(x, image.width, mips[0].width), line);
                    color.w = 1;
                    writeColor(color, texel);
                }
            });
}

} // namespace hearth::textures
