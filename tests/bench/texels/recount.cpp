// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/bench/texels/recount.h"

#include "formats/base/assert.h"
#include "formats/base/half.h"
#include "formats/pack/decode_image.h"
#include "formats/texels/swizzle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <vector>

namespace hearth::bench
{

using namespace formats;
using texels::PlainImage;

namespace
{

/// Red, green, blue and alpha: shares of the range, or floats.
using Texel = std::array<double, 4>;

template <typename T>
double readNumber(std::span<const std::byte> bytes, size_t at)
{
    T number;
    std::memcpy(&number, bytes.data() + at * sizeof(T), sizeof(T));
    return number;
}

/// Return all texels of a plain mip.
std::vector<Texel> readPlain(const PlainImage& image, uint32_t mip)
{
    size_t first = 0;
    const uint64_t channel_bytes =
        image.record.format <= static_cast<uint32_t>(TexelFormat::rgba8_unorm) ? 1 : 2;
    const auto count_texels = [&](uint32_t m)
    { return size_t{std::max(1u, image.record.width >> m)} * std::max(1u, image.record.height >> m); };
    for (uint32_t m = 0; m < mip; ++m)
        first += count_texels(m);
    const std::span<const std::byte> bytes = image.mips.subspan(first * 4 * channel_bytes);
    std::vector<Texel> texels(count_texels(mip));
    for (size_t i = 0; i < 4 * texels.size(); ++i)
    {
        double& channel = texels[i / 4][i % 4];
        if (image.record.format == static_cast<uint32_t>(TexelFormat::rgba16_float))
            channel = floatFromHalf(static_cast<uint16_t>(readNumber<uint16_t>(bytes, i)));
        else
            channel = channel_bytes == 1 ? readNumber<uint8_t>(bytes, i) / 255
                                         : readNumber<uint16_t>(bytes, i) / 65535;
    }
    return texels;
}

/// Return all texels of an encoded mip as shaders read them.
std::vector<Texel> readStored(const ImageRecord& stored, std::span<const std::byte> mips, uint32_t mip)
{
    const bool is_float = findTexelFormat(stored.format)->coding == TexelCoding::float_value;
    std::vector<Texel> texels;
    for (const DecodedTexel& decoded : decodeImageMip(stored, mips, mip))
    {
        const DecodedTexel read =
            applySwizzle(decoded, stored.swizzle, is_float ? kHalfOne : uint16_t{0xFFFF});
        Texel& texel = texels.emplace_back();
        for (size_t c = 0; c < 4; ++c)
            texel[c] = is_float ? double{floatFromHalf(read[c])} : read[c] / 65535.0;
    }
    return texels;
}

/// Return the unit vector of a normal map's texel.
std::array<double, 3> makeDirection(const Texel& texel)
{
    const double x = 2 * texel[0] - 1, y = 2 * texel[1] - 1, z2 = 1 - x * x - y * y;
    const double length = z2 > 0 ? 1 : std::hypot(x, y);
    return {x / length, y / length, z2 > 0 ? std::sqrt(z2) : 0};
}

/// Return the angle of two normals, by the chord between them.
double findAngle(const Texel& a, const Texel& b)
{
    const std::array<double, 3> from = makeDirection(a), to = makeDirection(b);
    const double chord = std::hypot(from[0] - to[0], from[1] - to[1], from[2] - to[2]);
    return 2 * std::asin(std::min(1.0, chord / 2));
}

/// Return the difference of a channel of two texels.
double findDifference(ImageRole role, const Texel& a, const Texel& b, size_t channel)
{
    const auto value = [&](const Texel& texel)
    {
        if (role == ImageRole::light)
            return std::log2(1 + std::max(0.0, texel[channel]));
        return role == ImageRole::cutout && channel < 3 ? texel[channel] * texel[3] : texel[channel];
    };
    return value(a) - value(b);
}

/// Channels that errors are counted in.
std::vector<size_t> listChannels(const PlainImage& image)
{
    std::vector<size_t> channels;
    for (size_t c = 0; c < 4; ++c)
        if (image.role == ImageRole::light ? c < 3 : (image.channels >> c & 1) != 0)
            channels.push_back(c);
    return channels;
}

struct MipTexels
{
    uint32_t width;
    std::vector<Texel> plain, stored;
    std::vector<bool> is_smooth; ///< of each texel
};

/// List the texels of a cell of 4 x 4.
std::vector<size_t> listCell(const MipTexels& mip, size_t column, size_t row)
{
    std::vector<size_t> texels;
    for (size_t y = 4 * row; y < std::min(mip.plain.size() / mip.width, 4 * row + 4); ++y)
        for (size_t x = 4 * column; x < std::min<size_t>(mip.width, 4 * column + 4); ++x)
            texels.push_back(y * mip.width + x);
    return texels;
}

/// True if no channel that is read spans more than 4 of 255 codes in a cell.
bool isFlat(const PlainImage& image, const MipTexels& mip, size_t column, size_t row)
{
    const std::vector<size_t> texels = listCell(mip, column, row);
    double span = 0;
    for (const size_t c : listChannels(image))
    {
        const auto [low, high] =
            std::minmax_element(texels.begin(), texels.end(),
                                [&](size_t a, size_t b) { return mip.plain[a][c] < mip.plain[b][c]; });
        span = std::max(span, mip.plain[*high][c] - mip.plain[*low][c]);
    }
    return span <= 4.0 / 255 + 1e-9;
}

/// Find the texels of smooth cells: flat ones with at most two among the eight around them that are not.
/// Cells of the border repeat beyond it. Return the number of smooth cells.
uint64_t findSmooth(const PlainImage& image, MipTexels& mip, uint64_t& cells)
{
    const auto columns = static_cast<ptrdiff_t>((mip.width + 3) / 4);
    const auto rows = static_cast<ptrdiff_t>((mip.plain.size() / mip.width + 3) / 4);
    std::vector<bool> is_flat;
    for (ptrdiff_t cell = 0; cell < columns * rows; ++cell)
        is_flat.push_back(
            isFlat(image, mip, static_cast<size_t>(cell % columns), static_cast<size_t>(cell / columns)));
    uint64_t smooth = 0;
    mip.is_smooth.resize(mip.plain.size());
    for (ptrdiff_t cell = 0; cell < columns * rows; ++cell)
    {
        int rough = 0;
        for (ptrdiff_t neighbour = 0; neighbour < 9; ++neighbour)
        {
            const ptrdiff_t x = std::clamp<ptrdiff_t>(cell % columns + neighbour % 3 - 1, 0, columns - 1);
            const ptrdiff_t y = std::clamp<ptrdiff_t>(cell / columns + neighbour / 3 - 1, 0, rows - 1);
            rough += is_flat[static_cast<size_t>(y * columns + x)] ? 0 : 1;
        }
        if (!is_flat[static_cast<size_t>(cell)] || rough > 2)
            continue;
        ++smooth;
        for (const size_t texel :
             listCell(mip, static_cast<size_t>(cell % columns), static_cast<size_t>(cell / columns)))
            mip.is_smooth[texel] = true;
    }
    cells += is_flat.size();
    return smooth;
}

/// Return the root of the mean over the mips of the mean squares of all texels, or of smooth ones.
double combine(const PlainImage& image, std::span<const MipTexels> mips, bool only_smooth)
{
    std::array<double, 4> means{};
    double counted_mips = 0;
    for (const MipTexels& mip : mips)
    {
        std::array<double, 4> sums{};
        double count = 0;
        for (size_t i = 0; i < mip.plain.size(); ++i)
        {
            if (only_smooth && !mip.is_smooth[i])
                continue;
            ++count;
            if (image.role == ImageRole::normal)
                sums[0] += std::pow(findAngle(mip.plain[i], mip.stored[i]), 2);
            else
                for (const size_t c : listChannels(image))
                    sums[c] += std::pow(findDifference(image.role, mip.plain[i], mip.stored[i], c), 2);
        }
        if (count == 0)
            continue;
        ++counted_mips;
        for (size_t c = 0; c < 4; ++c)
            means[c] += sums[c] / count;
    }
    if (counted_mips == 0)
        return 0;
    const double sum = means[0] + means[1] + means[2] + means[3];
    double mean = sum / static_cast<double>(std::max<size_t>(listChannels(image).size(), 1));
    if (image.role == ImageRole::normal)
        mean = sum;
    if (image.role == ImageRole::data)
        mean = *std::ranges::max_element(means);
    return std::sqrt(mean / counted_mips);
}

double findPercentile(const PlainImage& image, const MipTexels& mip)
{
    std::vector<double> errors(mip.plain.size());
    for (size_t i = 0; i < errors.size(); ++i)
    {
        if (image.role == ImageRole::normal)
            errors[i] = findAngle(mip.plain[i], mip.stored[i]);
        else
            for (const size_t c : listChannels(image))
                errors[i] =
                    std::max(errors[i], std::abs(findDifference(image.role, mip.plain[i], mip.stored[i], c)));
    }
    std::ranges::sort(errors);
    return errors[errors.size() - errors.size() / 1000 - 1];
}

double findCoverage(const ImageRecord& record, std::span<const MipTexels> mips)
{
    double largest = 0;
    if ((record.flags & kImageAlphaTested) == 0)
        return 0;
    for (const MipTexels& mip : mips)
    {
        const auto share = [&](const std::vector<Texel>& texels)
        {
            const auto passes = [&](const Texel& texel)
            { return static_cast<float>(texel[3]) >= record.alpha_cutoff; };
            return static_cast<double>(std::ranges::count_if(texels, passes)) /
                   static_cast<double>(texels.size());
        };
        largest = std::max(largest, std::abs(share(mip.stored) - share(mip.plain)));
    }
    return largest;
}

} // namespace

Recount recountErrors(const PlainImage& plain, const ImageRecord& stored, std::span<const std::byte> mips)
{
    std::vector<MipTexels> measured;
    uint64_t smooth = 0, cells = 0;
    for (uint32_t mip = 0; mip < std::min(4u, plain.record.mip_count); ++mip)
    {
        const uint32_t width = std::max(1u, plain.record.width >> mip),
                       height = std::max(1u, plain.record.height >> mip);
        if (mip > 0 && std::min(width, height) < 64)
            break;
        measured.push_back({width, readPlain(plain, mip), readStored(stored, mips, mip), {}});
        HEARTH_ASSERT(measured.back().plain.size() == measured.back().stored.size());
        smooth += findSmooth(plain, measured.back(), cells);
    }
    const bool is_color = findTexelFormat(plain.record.format)->coding == TexelCoding::srgb;
    return {.error = combine(plain, measured, false),
            .smooth = is_color && 2 * smooth >= cells ? combine(plain, measured, true) : 0,
            .p999 = findPercentile(plain, measured.front()),
            .coverage = findCoverage(plain.record, measured)};
}

} // namespace hearth::bench
