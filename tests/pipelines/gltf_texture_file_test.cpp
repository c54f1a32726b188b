// Tests images of glTF files that are textures as devices have them: DDS and KTX2.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/pipelines/gltf_fixture.h"
#include "tests/pipelines_scans/dds_builder.h"

#include <cmath>

namespace hearth::import
{

namespace
{

using namespace formats;
using namespace test;

std::string toText(const Bytes& bytes)
{
    return {bytes.begin(), bytes.end()};
}

/// Import a material whose textures are an image of MSFT_texture_dds.
/// textures  properties of the material
Imported importTexture(const Bytes& file, const std::string& textures)
{
    const TemporaryFolder folder;
    folder.write("a.dds", toText(file));
    return importBytes(R"({"asset":{"version":"2.0"},"extensionsUsed":["MSFT_texture_dds"],
        "extensionsRequired":["MSFT_texture_dds"],"images":[{"uri":"a.dds"}],
        "textures":[{"extensions":{"MSFT_texture_dds":{"source":0}}}],"materials":[{"name":"oak",)" +
                           textures + "}]}",
                       &folder);
}

constexpr const char* kColor = R"("emissiveTexture":{"index":0})";
constexpr const char* kData = R"("occlusionTexture":{"index":0})";
constexpr const char* kNormal = R"("normalTexture":{"index":0})";

TEST(GltfTextureFiles, areReadByTheirExtension)
{
    const Imported result =
        importTexture(Dds{.texels = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16}}.file(), kColor);
    ASSERT_TRUE(result.ok()) << result.message();
    EXPECT_EQ(result.texels(0),
              (std::vector<uint8_t>{3, 2, 1, 4, 7, 6, 5, 8, 11, 10, 9, 12, 15, 14, 13, 16}));
    EXPECT_FALSE(result.hasWarning(Issue::image_replaced, ""));
    EXPECT_FALSE(result.hasWarning(Issue::dropped, ""));
}

TEST(GltfTextureFiles, sayInOneMessageThatTheyAreDamaged)
{
    Bytes file = Dds().file();
    file.pop_back();
    const Imported result = importTexture(file, kColor);
    ASSERT_TRUE(result.ok()) << result.message();
    EXPECT_TRUE(
        result.hasWarning(Issue::image_replaced, "image \"a.dds\" of material \"oak\": DDS: the file ends"));
}

TEST(GltfTextureFiles, giveNormalsOfTwoChannelsTheirZ)
{
    // 8 bits, and 16 bits by BC5 with constant blocks: x 0.6, y 0
    Dds two = Dds::withDxgi(49, {204, 128, 255, 128, 128, 128, 255, 255});
    const Imported result = importTexture(two.file(), kNormal);
    ASSERT_TRUE(result.ok()) << result.message();
    const std::vector<uint8_t> texels = result.texels(0);
    ASSERT_EQ(texels.size(), 16u);
    for (size_t i = 0; i < texels.size(); i += 4)
    {
        const double x = texels[i] / 127.5 - 1, y = texels[i + 1] / 127.5 - 1;
        EXPECT_NEAR(texels[i + 2] / 127.5 - 1, std::sqrt(std::max(0.0, 1 - x * x - y * y)), 0.5 / 127.5);
    }

    Bytes block;
    for (const uint8_t code : {uint8_t{204}, uint8_t{128}})
        append(block, code | uint32_t{code} << 8, 8);
    const Imported wide = importTexture(Dds::withCode("ATI2", block).file(), kNormal);
    ASSERT_TRUE(wide.ok()) << wide.message();
    const std::vector<uint8_t> words = wide.texels(0);
    ASSERT_FALSE(words.empty());
    const size_t channel = words.size() == 16 ? 1 : 2;
    EXPECT_NEAR(words[3 * channel - 1], 230, 1) << "the high byte of z = 0.8";

    const Imported data = importTexture(two.file(), kData);
    EXPECT_EQ(data.texels(0)[2], 0) << "numbers that are no normals stay";
}

TEST(GltfTextureFiles, sayThatTheirTransferFunctionContradictsTheirUse)
{
    const Bytes srgb = Dds::withDxgi(29, Bytes(16, 9)).file(),
                unsaid = Dds::withDxgi(28, Bytes(16, 9)).file();
    const Bytes linear = Ktx2{.transfer = 1}.file();
    EXPECT_TRUE(importTexture(srgb, kData)
                    .hasWarning(Issue::inconsistent,
                                "image \"a.dds\" of material \"oak\": its file says colours in sRGB"));
    EXPECT_FALSE(importTexture(srgb, kColor).hasWarning(Issue::inconsistent, ""));
    EXPECT_TRUE(
        importTexture(linear, kColor).hasWarning(Issue::inconsistent, "its file says linear numbers"));
    EXPECT_FALSE(importTexture(linear, kNormal).hasWarning(Issue::inconsistent, ""));
    for (const char* use : {kColor, kData, kNormal})
        EXPECT_FALSE(importTexture(unsaid, use).hasWarning(Issue::inconsistent, "")) << use;
    EXPECT_EQ(importTexture(srgb, kData).texels(0)[0], 9) << "the use decides";
}

} // namespace

} // namespace hearth::import
