// Tests reading environments: values beyond half floats, cubes, and what is refused.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/environments/read_environment.h"
#include "tests/pipelines_scans/ktx2_builder.h"
#include "tests/support/temporary_folder.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfRgbaFile.h>

#include <gtest/gtest.h>

#include <bit>
#include <limits>

namespace hearth::environments
{

namespace
{

using environment::Environment;
using environment::Layout;
using import::test::Bytes;
using import::test::Ktx2;

Result<Environment> decode(const Bytes& bytes)
{
    return decodeEnvironment(std::as_bytes(std::span(bytes)), "sky");
}

Environment decodeGood(const Bytes& bytes)
{
    Result<Environment> environment = decode(bytes);
    EXPECT_TRUE(environment.ok()) << (environment.ok() ? "" : formatMessage(environment.error()));
    return environment.ok() ? *environment : Environment{};
}

void expectRefused(const Bytes& bytes, Issue issue, const std::string& text)
{
    const Result<Environment> environment = decode(bytes);
    ASSERT_FALSE(environment.ok()) << text;
    EXPECT_EQ(environment.error().issue, issue);
    EXPECT_NE(environment.error().detail.find(text), std::string::npos) << environment.error().detail;
}

Bytes hdr(const std::string& resolution, const Bytes& body)
{
    const std::string header = "#?RADIANCE\n\n" + resolution + "\n";
    Bytes bytes(header.begin(), header.end());
    bytes.insert(bytes.end(), body.begin(), body.end());
    return bytes;
}

/// Cube of 1 x 1 texels of R32G32B32_SFLOAT.
Ktx2 floatCube(const std::array<Float3, 6>& faces)
{
    Ktx2 cube;
    cube.vk_format = 106;
    cube.width = cube.height = 1;
    cube.faces = 6;
    cube.channels = {0, 1, 2};
    cube.levels = {Bytes()};
    for (const Float3& face : faces)
        for (int c = 0; c < 3; ++c)
            import::test::append(cube.levels[0], std::bit_cast<uint32_t>(face[c]), 4);
    cube.uncompressed = {cube.levels[0].size()};
    return cube;
}

/// Write an EXR of floats, 2 x 1 texels, with the named channels; channel c of texel x is (c + 1) *
/// scale[x].
std::string writeExr(const std::string& path, const std::string& names, Float2 scale)
{
    Imf::Header header(2, 1);
    Imf::FrameBuffer buffer;
    std::vector<std::array<float, 2>> values;
    values.reserve(names.size());
    for (size_t c = 0; c < names.size(); ++c)
    {
        const std::string name(1, names[c]);
        header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        const auto factor = static_cast<float>(c + 1);
        values.push_back({factor * scale.x, factor * scale.y});
        buffer.insert(
            name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.back().data()), sizeof(float), 0));
    }
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(buffer);
    file.writePixels(1);
    return path;
}

class ReadExr : public testing::Test
{
protected:
    Environment read(const std::string& path)
    {
        Result<Environment> environment = readEnvironment(path);
        EXPECT_TRUE(environment.ok()) << (environment.ok() ? "" : formatMessage(environment.error()));
        return environment.ok() ? *environment : Environment{};
    }
    std::string path() const { return folder_.file("sky.exr"); }

private:
    test::TemporaryFolder folder_;
};

} // namespace

TEST(DecodeEnvironment, keepsSunsOfHdrBeyondHalfFloats)
{
    const Environment sky = decodeGood(hdr("-Y 1 +X 2", {128, 64, 0, 129, 128, 128, 255, 157}));
    EXPECT_EQ(sky.layout, Layout::lat_long);
    ASSERT_EQ(sky.texels.size(), 2u);
    EXPECT_EQ(sky.texels[0], (Float3{1, 0.5f, 0}));
    const float sun = 268435456; // 128 * 2 ^ (157 - 136)
    EXPECT_EQ(sky.texels[1], (Float3{sun, sun, sun * 255 / 128}));
}

TEST(DecodeEnvironment, readsHdrThatIsUpsideDown)
{
    const Environment sky =
        decodeGood(hdr("+Y 2 +X 4", {1, 0, 0, 136, 2, 0, 0, 136, 3, 0, 0, 136, 4, 0, 0, 136,
                                     5, 0, 0, 136, 6, 0, 0, 136, 7, 0, 0, 136, 8, 0, 0, 136}));
    ASSERT_EQ(sky.texels.size(), 8u);
    EXPECT_EQ(sky.texels[sky.index(0, 0, 0)].x, 5);
    EXPECT_EQ(sky.texels[sky.index(0, 3, 1)].x, 4);
}

TEST(DecodeEnvironment, readsCubesOfFloatsAndHalves)
{
    const Ktx2 floats =
        floatCube({Float3{1, 2, 3}, {4e8f, 5, 6}, {7, 8, 9}, {0, 0, 0}, {-1, 2, 3}, {4, 5, 6}});
    const Environment sky = decodeGood(floats.file());
    EXPECT_EQ(sky.layout, Layout::cube);
    EXPECT_EQ(sky.width, 1u);
    ASSERT_EQ(sky.texels.size(), 6u);
    EXPECT_EQ(sky.texels[1], (Float3{4e8f, 5, 6}));
    EXPECT_EQ(sky.texels[4], (Float3{0, 2, 3})) << "negative radiance is none";

    Ktx2 halves = floats;
    halves.vk_format = 97; // R16G16B16A16_SFLOAT
    halves.channels = {0, 1, 2, 15};
    halves.levels = {Bytes()};
    for (uint32_t face = 0; face < 6; ++face)
        for (const uint32_t half : {0x3C00u + face, 0x4000u, 0x4200u, 0x3C00u})
            import::test::append(halves.levels[0], half, 2);
    halves.uncompressed = {halves.levels[0].size()};
    const Environment half_sky = decodeGood(halves.file());
    ASSERT_EQ(half_sky.texels.size(), 6u);
    EXPECT_EQ(half_sky.texels[5], (Float3{1 + 5.0f / 1024, 2, 3}));
}

TEST(DecodeEnvironment, refusesWhatIsNoEnvironment)
{
    expectRefused({0x89, 'P', 'N', 'G'}, Issue::image_unsupported, "HDR, EXR or KTX2");
    expectRefused({}, Issue::image_unsupported, "HDR, EXR or KTX2");
    expectRefused(hdr("-Y 2 +X 2", Bytes(16)), Issue::image_unsupported, "2 x 2");
    expectRefused(hdr("-Y 1 +X 2", {1, 2, 3}), Issue::image_malformed, "too early");
    expectRefused(Ktx2().file(), Issue::image_unsupported, "no floats");
    Ktx2 short_cube = floatCube({});
    short_cube.levels[0].resize(60);
    short_cube.uncompressed = {60};
    expectRefused(short_cube.file(), Issue::image_malformed, "size");
    Ktx2 upside_down = floatCube({});
    upside_down.addText("KTXorientation", "ru");
    expectRefused(upside_down.file(), Issue::image_unsupported, "KTXorientation");
}

TEST(DecodeEnvironment, namesTexelsThatAreNotFinite)
{
    std::array<Float3, 6> faces{};
    faces[2].y = std::numeric_limits<float>::quiet_NaN();
    expectRefused(floatCube(faces).file(), Issue::image_malformed, "texel (0, 0) of face 2 is not a number");
    faces[2].y = std::numeric_limits<float>::infinity();
    expectRefused(floatCube(faces).file(), Issue::image_malformed, "texel (0, 0) of face 2 is infinite");
}

TEST(DecodeEnvironment, refusesFilesThatAreCutOrDamaged)
{
    const Bytes header = floatCube({Float3{1, 2, 3}}).file();
    const Bytes image = hdr("-Y 2 +X 4", Bytes(32, 100));
    for (const Bytes& file : {header, image})
    {
        for (size_t size = 0; size < file.size(); ++size)
            EXPECT_FALSE(decode(Bytes(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(size))).ok())
                << size;
        for (size_t at = 0; at < file.size(); ++at)
            for (const unsigned change : {0x01u, 0x80u, 0xFFu})
            {
                Bytes damaged = file;
                damaged[at] = static_cast<uint8_t>(damaged[at] ^ change);
                const Result<Environment> sky = decode(damaged);
                EXPECT_TRUE(!sky.ok() ||
                            sky->texels.size() == size_t{sky->width} * sky->height * sky->panelCount());
            }
    }
}

TEST(DecodeEnvironment, leavesCubesToEnvironments)
{
    const Bytes file = floatCube({}).file();
    const auto image = import::decodeImage(std::as_bytes(std::span(file)), "texture", {});
    ASSERT_FALSE(image.ok());
    EXPECT_EQ(image.error().issue, Issue::image_unsupported);
}

TEST_F(ReadExr, keepsFloats)
{
    const Environment sky = read(writeExr(path(), "RGB", {1e6f, 1e-9f}));
    ASSERT_EQ(sky.texels.size(), 2u);
    EXPECT_EQ(sky.texels[0], (Float3{1e6f, 2e6f, 3e6f}));
    EXPECT_EQ(sky.texels[1], (Float3{1 * 1e-9f, 2 * 1e-9f, 3 * 1e-9f}));
}

TEST_F(ReadExr, readsGreyAndMissingChannels)
{
    EXPECT_EQ(read(writeExr(path(), "Y", {1e6f, 2})).texels[0], (Float3{1e6f, 1e6f, 1e6f}));
    EXPECT_EQ(read(writeExr(path(), "B", {5, 2})).texels[0], (Float3{0, 0, 5}));
}

TEST_F(ReadExr, readsChroma)
{
    {
        Imf::RgbaOutputFile file(path().c_str(), 2, 2, Imf::WRITE_YC);
        const std::vector<Imf::Rgba> texels(4, Imf::Rgba(2, 2, 2, 1));
        file.setFrameBuffer(texels.data(), 1, 2);
        file.writePixels(2);
    }
    const Result<Environment> square = readEnvironment(path());
    ASSERT_FALSE(square.ok());
    EXPECT_NE(square.error().detail.find("2 x 2"), std::string::npos);
    {
        Imf::RgbaOutputFile file(path().c_str(), 4, 2, Imf::WRITE_YC);
        const std::vector<Imf::Rgba> texels(8, Imf::Rgba(2, 2, 2, 1));
        file.setFrameBuffer(texels.data(), 1, 4);
        file.writePixels(2);
    }
    const Environment sky = read(path());
    ASSERT_EQ(sky.texels.size(), 8u);
    EXPECT_NEAR(sky.texels[5].y, 2, 0.01);
}

TEST_F(ReadExr, refusesOtherChannels)
{
    const Result<Environment> depth = readEnvironment(writeExr(path(), "Z", {1, 2}));
    ASSERT_FALSE(depth.ok());
    EXPECT_EQ(depth.error().issue, Issue::image_unsupported);
}

TEST(ReadEnvironment, tellsOfAMissingFile)
{
    const Result<Environment> environment = readEnvironment("/nowhere/sky.hdr");
    ASSERT_FALSE(environment.ok());
    EXPECT_EQ(environment.error().issue, Issue::input_missing);
}

} // namespace hearth::environments
