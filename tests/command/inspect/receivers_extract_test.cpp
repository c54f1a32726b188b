// Tests `hearth extract --receivers` with the decoders that read images of others.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/extract/extract_receivers.h"
#include "pipelines/import/images/decode.h"
#include "pipelines/import/images/float_image.h"
#include "tests/support/sandbox.h"
#include "tests/support/small_parts.h"

#include <gtest/gtest.h>

#include <map>

namespace hearth::test
{

namespace
{

/// Light of the texels of smallPack() with all lamps on, by hand: mantissas over 512 times powers of two.
const std::map<std::pair<uint32_t, uint32_t>, Float3> kLight{
    {{0, 0}, {0.5f * (256 / 512.0f + 300 / 1024.0f), 0, 0}},
    {{2, 2}, {0.5f * (128 / 512.0f), 0, 0}},
    {{5, 1}, {0.5f * (511 / 256.0f), 0.5f * (256 / 16.0f), 0}}};

Float3 expectedAt(uint32_t x, uint32_t y)
{
    const auto found = kLight.find({x, y});
    return found == kLight.end() ? Float3{} : found->second;
}

class ExtractReceivers : public testing::TestWithParam<bool>
{
protected:
    std::string extract(const std::string& name)
    {
        writePackFile(smallPack(), sandbox / "small.hearth");
        writeReceiversPart(smallPack(), sandbox / "small.part");
        const Status status =
            command::extractReceivers(sandbox / (GetParam() ? "small.part" : "small.hearth"), sandbox / name);
        EXPECT_TRUE(status.ok()) << (status.ok() ? "" : formatMessage(status.error()));
        return sandbox.read(name);
    }

    Sandbox sandbox;
};

} // namespace

TEST_P(ExtractReceivers, writesIrradianceAsExr)
{
    const std::string file = extract("light.exr"), name = "light.exr";
    const auto image = import::decodeExrFloats({std::as_bytes(std::span(file)), name, {}});
    ASSERT_TRUE(image.ok()) << formatMessage(image.error());
    ASSERT_EQ(image->width, 6u);
    ASSERT_EQ(image->height, 4u);
    for (uint32_t y = 0; y < 4; ++y)
        for (uint32_t x = 0; x < 6; ++x)
            EXPECT_EQ(image->texels[6 * y + x], expectedAt(x, y)) << x << ' ' << y;
}

TEST_P(ExtractReceivers, writesAPictureAsPng)
{
    const std::string file = extract("light.png");
    const auto image = import::decodeImage(std::as_bytes(std::span(file)), "light.png", {});
    ASSERT_TRUE(image.ok()) << formatMessage(image.error());
    for (uint32_t y = 0; y < 4; ++y)
        for (uint32_t x = 0; x < 6; ++x)
        {
            const double light = double{expectedAt(x, y).x};
            const auto code = std::to_integer<int>(image->texels[4 * (6 * y + x)]) / 255.0;
            const double shown = code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
            EXPECT_NEAR(shown, light / (1 + light), 0.005) << x << ' ' << y;
        }
}

TEST_P(ExtractReceivers, refusesOtherFiles)
{
    extract("light.exr");
    EXPECT_EQ(command::extractReceivers(sandbox / "small.part", sandbox / "light.csv").error().issue,
              Issue::usage);
    writeBricksPart(smallPack(), sandbox / "bricks.part");
    EXPECT_EQ(command::extractReceivers(sandbox / "bricks.part", sandbox / "t.png").error().issue,
              Issue::chunk_missing);
    PackModel wrong = smallPack();
    wrong.receiver_blocks[0].texel_count = 65;
    writeReceiversPart(wrong, sandbox / "wrong.part");
    EXPECT_EQ(command::extractReceivers(sandbox / "wrong.part", sandbox / "t.png").error().issue,
              Issue::meaning_value);
}

INSTANTIATE_TEST_SUITE_P(OfPacksAndParts, ExtractReceivers, testing::Bool());

} // namespace hearth::test
