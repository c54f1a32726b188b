// The blocks of an image depend on the image alone, whatever its process encoded before.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/encoding/encode.h"
#include "tests/texels/test_images.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <string>
#include <unistd.h>

namespace hearth::texels
{

namespace
{

using namespace test;
using namespace formats;

/// Encode an image of 200 x 50 texels in ASTC, in blocks of `width` x `width` texels. Its grain grows to the
/// right, so that there are blocks about every limit at which libastcenc may be content.
std::vector<std::byte> encodeBlocks(uint32_t width, Effort effort)
{
    const ChannelValue waves = photographic(0), grain = photographic(1);
    const auto value = [&](uint32_t c, double x, double y)
    { return waves(c, x, y) + 0.15 * x * (grain(c, x, y) - waves(c, x, y)); };
    const TestImage owned = makeImage(200, 50, 1, TexelFormat::rgba8_srgb, value);
    const PlainImage image = owned.plain(ImageRole::color, kRgb);
    const std::vector<Candidate> candidates = listCandidates(image, {.astc = true});
    const auto candidate =
        std::ranges::find_if(candidates, [&](const Candidate& c)
                             { return c.traits->block_width == width && c.traits->block_height == width; });
    return encodeImage(image, findSmoothCells(image), *candidate, effort);
}

void writeBlocks(const std::string& path)
{
    const std::vector<std::byte> blocks = encodeBlocks(5, Effort::normal);
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(blocks.data()), static_cast<std::streamsize>(blocks.size()));
}

std::string readAndRemove(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    std::string content(std::istreambuf_iterator<char>(file), {});
    std::filesystem::remove(path);
    return content;
}

TEST(AstcEncoderDeathTest, blocksDoNotDependOnEarlierImages)
{
    GTEST_FLAG_SET(death_test_style, "threadsafe"); // each statement in a new process of this program
    // The new processes find the first one's name in the environment.
    const std::string own_name = ::testing::TempDir() + "astc-encoder-" + std::to_string(::getpid());
    ::setenv("HEARTH_TEST_BLOCKS", own_name.c_str(), 0);
    const std::string name = std::getenv("HEARTH_TEST_BLOCKS");
    EXPECT_EXIT((writeBlocks(name + ".alone"), std::exit(0)), ::testing::ExitedWithCode(0), "");
    EXPECT_EXIT((encodeBlocks(4, Effort::normal), writeBlocks(name + ".later"), std::exit(0)),
                ::testing::ExitedWithCode(0), "");
    const std::string alone = readAndRemove(name + ".alone"), later = readAndRemove(name + ".later");
    ASSERT_FALSE(alone.empty());
    EXPECT_EQ(alone, later);
}

} // namespace

} // namespace hearth::texels
