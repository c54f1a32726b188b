// Errors of codes are what a sum in floating point says, for any number of texels.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/encoding/texel_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace hearth::texels
{

namespace
{

using namespace formats;

std::vector<DecodedTexel> makeTexels(size_t count, std::mt19937& random)
{
    std::vector<DecodedTexel> texels(count);
    for (DecodedTexel& texel : texels)
        for (uint16_t& value : texel)
            // ends of the range are as frequent as all between
            value = static_cast<uint16_t>((random() & 1) != 0   ? random() & 0xFFFF
                                          : (random() & 1) != 0 ? 0xFFFF
                                                                : 0);
    return texels;
}

/// Return the code of a channel; of cutouts colour times alpha, rounded.
double readCode(ImageRole role, const DecodedTexel& texel, size_t c)
{
    const double code = texel[c], alpha = texel[3];
    return role == ImageRole::cutout && c < 3 ? std::floor(code * alpha / 65535 + 0.5) : code;
}

TEST(TexelError, codesAreComparedForAnyNumberOfTexels)
{
    std::mt19937 random(5);
    constexpr std::array<uint32_t, 3> kChannels{1, 7, 15};
    for (const size_t count : {1u, 2u, 7u, 256u, 70001u})
        for (const ImageRole role : {ImageRole::color, ImageRole::data, ImageRole::cutout})
            for (const uint32_t mask : kChannels)
            {
                const auto channels = static_cast<Channels>(mask);
                const std::vector<DecodedTexel> plain = makeTexels(count, random),
                                                stored = makeTexels(count, random);
                ErrorSum sum(role, channels);
                sum.add(plain, stored);
                std::vector<uint16_t> differences(count);
                findCodeDifferences(role, channels, plain, stored, differences);
                std::array<double, 4> squares{};
                for (size_t i = 0; i < count; ++i)
                {
                    double largest = 0;
                    for (size_t c = 0; c < 4; ++c)
                        if ((mask >> c & 1) != 0)
                        {
                            const double difference =
                                std::abs(readCode(role, plain[i], c) - readCode(role, stored[i], c));
                            squares[c] += difference * difference / (65535.0 * 65535.0);
                            largest = std::max(largest, difference);
                        }
                    ASSERT_EQ(differences[i], largest) << i << " of " << count;
                }
                for (size_t c = 0; c < 4; ++c)
                    EXPECT_NEAR(sum.meanSquares()[c], squares[c] / static_cast<double>(count), 1e-12);
            }
}

} // namespace

} // namespace hearth::texels
