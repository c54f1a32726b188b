// Tests `hearth extract --probe` with the decoders that read images of others.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/texels/shared_exponent.h"
#include "pipelines/command/extract/extract_probe.h"
#include "pipelines/import/images/decode.h"
#include "pipelines/import/images/float_image.h"
#include "tests/support/sandbox.h"
#include "tests/support/small_parts.h"

#include <gtest/gtest.h>

#include <cstring>
#include <numbers>
#include <sstream>

namespace hearth::test
{

namespace
{

/// Probe of smallPack(): each face has one colour, the same in its two mips.
std::array<float, 3> faceColor(uint32_t face)
{
    return formats::decodeSharedExponent(smallPack().probe_texels[4 * face]);
}

class ExtractProbe : public testing::Test
{
protected:
    ExtractProbe() { writePackFile(smallPack(), sandbox / "small.hearth"); }

    std::string extract(const std::string& name, std::optional<uint32_t> index = std::nullopt,
                        const std::string& pack = "small.hearth")
    {
        const Status status = command::extractProbe(sandbox / pack, index, sandbox / name);
        EXPECT_TRUE(status.ok()) << (status.ok() ? "" : formatMessage(status.error()));
        return sandbox.read(name);
    }

    /// Write a pack of two probes: that of smallPack(), and one with the colours of the next faces.
    void writeTwoProbes() const
    {
        PackModel model = smallPack();
        const std::vector<uint32_t> first = model.probe_texels;
        model.probes.push_back(model.probes[0]);
        model.probes[1].texels.first = static_cast<uint32_t>(first.size());
        for (size_t i = 0; i < first.size(); ++i)
            model.probe_texels.push_back(first[(i + 4) % 24]);
        writePackFile(model, sandbox / "two.hearth");
    }

    /// Calls check(x, y, face) for each texel of the picture: of no face it is 6.
    template <typename Check>
    static void forEachTexel(Check&& check)
    {
        for (uint32_t y = 0; y < 3; ++y)
            for (uint32_t x = 0; x < 12; ++x)
                check(x, y, y < 2 ? x / 2 : std::min(x, 6u));
    }

    Sandbox sandbox;
};

} // namespace

TEST_F(ExtractProbe, listsTheMips)
{
    std::istringstream lines(extract("probe.csv"));
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "probe,mip,side,roughness,mean_r,mean_g,mean_b,least,greatest");
    double mean[3] = {};
    float least = 1e9f, greatest = 0;
    for (uint32_t face = 0; face < 6; ++face)
        for (size_t c = 0; c < 3; ++c)
        {
            mean[c] += double{faceColor(face)[c]} / 6;
            least = std::min(least, faceColor(face)[c]);
            greatest = std::max(greatest, faceColor(face)[c]);
        }
    for (int mip = 0; mip < 2; ++mip)
    {
        std::getline(lines, line);
        std::istringstream numbers(line);
        double values[9];
        for (double& value : values)
        {
            numbers >> value;
            numbers.ignore();
        }
        EXPECT_EQ(values[0], 0) << "the only probe";
        EXPECT_EQ(values[1], mip);
        EXPECT_EQ(values[2], 2 - mip);
        EXPECT_EQ(values[3], mip) << "roughness 0 and 1";
        for (size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(values[4 + c], mean[c], 1e-6) << "faces count the same";
        EXPECT_NEAR(values[7], least, 1e-6);
        EXPECT_NEAR(values[8], greatest, 1e-6);
    }
    EXPECT_FALSE(std::getline(lines, line));
}

TEST_F(ExtractProbe, listsAllProbesOrTheOneOfAnIndex)
{
    writeTwoProbes();
    std::istringstream lines(extract("all.csv", std::nullopt, "two.hearth"));
    std::string header, line, of_second;
    std::getline(lines, header);
    for (const std::string start : {"0,0,2,", "0,1,1,", "1,0,2,", "1,1,1,"})
    {
        ASSERT_TRUE(std::getline(lines, line));
        EXPECT_TRUE(line.starts_with(start)) << line;
        of_second += start[0] == '1' ? line + '\n' : "";
    }
    EXPECT_FALSE(std::getline(lines, line));
    EXPECT_EQ(extract("second.csv", 1, "two.hearth"), header + '\n' + of_second);
}

TEST_F(ExtractProbe, picturesShowOneProbe)
{
    writeTwoProbes();
    EXPECT_EQ(extract("first.exr", 0, "two.hearth"), extract("only.exr"));
    EXPECT_NE(extract("second.exr", 1, "two.hearth"), extract("only.exr"));
    for (const std::string name : {"all.exr", "all.png"})
    {
        const Status status = command::extractProbe(sandbox / "two.hearth", std::nullopt, sandbox / name);
        ASSERT_FALSE(status.ok());
        EXPECT_EQ(status.error().issue, Issue::usage);
        EXPECT_NE(status.error().detail.find("one of the 2 probes"), std::string::npos);
        EXPECT_NE(status.error().detail.find("0 to 1"), std::string::npos) << status.error().detail;
        EXPECT_FALSE(sandbox.has(name));
    }
}

TEST_F(ExtractProbe, writesTheTexelsAsExr)
{
    const std::string file = extract("probe.exr"), name = "probe.exr";
    const auto image = import::decodeExrFloats({std::as_bytes(std::span(file)), name, {}});
    ASSERT_TRUE(image.ok()) << formatMessage(image.error());
    ASSERT_EQ(image->width, 12u);
    ASSERT_EQ(image->height, 3u);
    forEachTexel(
        [&](uint32_t x, uint32_t y, uint32_t face)
        {
            const Float3 got = image->texels[12 * y + x];
            const auto expected = face == 6 ? std::array<float, 3>{} : faceColor(face);
            EXPECT_EQ(got, (Float3{expected[0], expected[1], expected[2]})) << x << ' ' << y;
        });
}

TEST_F(ExtractProbe, writesAPictureAsPng)
{
    const std::string file = extract("probe.png");
    const auto image = import::decodeImage(std::as_bytes(std::span(file)), "probe.png", {});
    ASSERT_TRUE(image.ok()) << formatMessage(image.error());
    ASSERT_EQ(image->width, 12u);
    ASSERT_EQ(image->height, 3u);
    forEachTexel(
        [&](uint32_t x, uint32_t y, uint32_t face)
        {
            for (size_t c = 0; c < 3; ++c)
            {
                const double radiance = face == 6 ? 0 : std::numbers::pi * double{faceColor(face)[c]};
                const auto code = std::to_integer<int>(image->texels[4 * (12 * y + x) + c]) / 255.0;
                const double light = code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
                EXPECT_NEAR(light, radiance / (1 + radiance), 0.005) << x << ' ' << y;
            }
        });
}

TEST_F(ExtractProbe, refusesOtherFiles)
{
    const auto expectIssue = [&](const std::string& input, const std::string& output, Issue issue,
                                 std::optional<uint32_t> index = std::nullopt)
    {
        const Status status = command::extractProbe(sandbox / input, index, sandbox / output);
        ASSERT_FALSE(status.ok());
        EXPECT_EQ(status.error().issue, issue);
        EXPECT_FALSE(sandbox.has(output));
    };
    expectIssue("small.hearth", "probe.jpg", Issue::usage);
    expectIssue("none.hearth", "probe.csv", Issue::input_missing);
    expectIssue("small.hearth", "probe.csv", Issue::usage, 1);
    PackModel model = smallPack();
    model.probes.clear();
    model.probe_texels.clear();
    writePackFile(model, sandbox / "dark.hearth");
    expectIssue("dark.hearth", "probe.csv", Issue::chunk_missing);
}

} // namespace hearth::test
