// Generates images with the content of real ones for tests of encoding: gradients, edges, grain.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/encoding/plain_image.h"

#include <cmath>
#include <cstddef>
#include <functional>
#include <random>
#include <vector>

namespace hearth::texels::test
{

/// Image that owns its mips.
struct TestImage
{
    formats::ImageRecord record{};
    std::vector<std::byte> mips{};

    PlainImage plain(formats::ImageRole role, Channels channels) const
    {
        return {.record = record, .mips = mips, .role = role, .channels = channels};
    }
};

/// Return a channel, 0 to 1, of a mip at a place: x and y from 0 to 1.
using ChannelValue = std::function<double(uint32_t channel, double x, double y)>;

/// Make an image of 8 bits a channel, with `mip_count` mips.
inline TestImage makeImage(uint32_t width, uint32_t height, uint32_t mip_count, formats::TexelFormat format,
                           const ChannelValue& value)
{
    TestImage image;
    image.record.width = width;
    image.record.height = height;
    image.record.mip_count = mip_count;
    image.record.format = static_cast<uint32_t>(format);
    for (uint32_t mip = 0; mip < mip_count; ++mip)
    {
        const formats::MipExtent extent = formats::mipExtent(image.record, mip);
        for (uint32_t y = 0; y < extent.height; ++y)
            for (uint32_t x = 0; x < extent.width; ++x)
                for (uint32_t c = 0; c < 4; ++c)
                {
                    const double v = value(c, (x + 0.5) / extent.width, (y + 0.5) / extent.height);
                    image.mips.push_back(static_cast<std::byte>(
                        static_cast<uint8_t>(std::lround(std::clamp(v, 0.0, 1.0) * 255))));
                }
    }
    return image;
}

/// Return a value with broad waves, an edge and grain of a strength.
inline ChannelValue photographic(double grain, uint32_t seed = 1)
{
    return [grain, random = std::mt19937(seed)](uint32_t c, double x, double y) mutable
    {
        if (c == 3)
            return 1.0;
        const double wave = 0.5 + 0.25 * std::sin(9 * x + c) * std::cos(7 * y - 0.5 * c);
        const double edge = std::abs(std::fmod(5 * x + 3 * y, 1.0)) < 0.4 ? 0.2 : 0;
        return wave + edge + grain * (static_cast<double>(random() & 0xFFFF) / 65535.0 - 0.5);
    };
}

/// Return a channel of unit normals of a bumpy surface.
inline ChannelValue bumps(double steepness)
{
    return [steepness](uint32_t c, double x, double y)
    {
        const double nx = steepness * std::sin(40 * x + 11 * y), ny = steepness * std::cos(31 * y - 7 * x);
        const double length = std::sqrt(nx * nx + ny * ny + 1);
        const double normal[] = {nx / length, ny / length, 1 / length, 1};
        return c == 3 ? 1 : normal[c] * 0.5 + 0.5;
    };
}

} // namespace hearth::texels::test
