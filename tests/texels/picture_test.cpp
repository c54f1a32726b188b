// Pictures of errors: black where nothing is lost, brighter where more is.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/picture.h"
#include "tests/texels/test_images.h"

#include <gtest/gtest.h>

namespace hearth::texels
{

namespace
{

using namespace test;
using namespace formats;

uint64_t sumHalf(const Picture& picture, bool is_right)
{
    uint64_t sum = 0;
    for (uint32_t y = 0; y < picture.height; ++y)
        for (uint32_t x = 0; x < picture.width / 2; ++x)
            for (const uint8_t code :
                 picture.pixels[y * picture.width + x + (is_right ? picture.width / 2 : 0)])
                sum += code;
    return sum;
}

TEST(Pictures, showWhereTheErrorIs)
{
    const TestImage image = makeImage(256, 128, 2, TexelFormat::rgba8_srgb,
                                      [grain = photographic(0.5)](uint32_t c, double x, double y) {
                                          return c == 3 ? 1.0 : x < 0.5 ? 0.25 : grain(c, x, y);
                                      });
    const PlainImage plain = image.plain(ImageRole::color, kRgb);
    const std::vector<Candidate> candidates = listCandidates(plain, {.astc = true});
    const Target target = findTarget(plain.role, Effort::draft);

    const PicturePair lossy =
        drawPictures(plain, encodeCandidate(plain, candidates.front(), target, Effort::draft));
    EXPECT_EQ(lossy.thumbnail.width, 128u);
    EXPECT_EQ(lossy.thumbnail.height, 64u);
    EXPECT_EQ(lossy.thumbnail.pixels[0][1], 64) << "0.25 of 255";
    EXPECT_GT(sumHalf(lossy.error, true), 50 * sumHalf(lossy.error, false));

    const PicturePair exact =
        drawPictures(plain, encodeCandidate(plain, candidates.back(), target, Effort::draft));
    EXPECT_EQ(sumHalf(exact.error, true) + sumHalf(exact.error, false), 0u);
    EXPECT_EQ(exact.thumbnail.pixels, lossy.thumbnail.pixels);

    const Picture sheet = drawSheet({lossy, exact});
    EXPECT_EQ(sheet.width, 4 * kPictureSide);
    const SheetPlace place = findSheetPlace(1);
    EXPECT_EQ(sheet.pixels[place.y * sheet.width + place.x], exact.thumbnail.pixels[0]);
}

} // namespace

} // namespace hearth::texels
