// Compares mips of the texture cooker with those that oiiotool makes by its own filters: a second opinion.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/textures/mip_chain.h"
#include "formats/base/half.h"
#include "formats/pack/pack_view.h"
#include "pipelines/import/images/decode.h"
#include "tests/pipelines_images/images_fixture.h"
#include "tests/pipelines_images/oiiotool.h"

#include <algorithm>
#include <cmath>

namespace hearth::test
{

namespace
{

using formats::ImageRecord;
using formats::TexelFormat;

/// A kind of texels, and what oiiotool does before and after it averages them.
struct Kind
{
    const char* name;
    TexelFormat format;
    uint32_t flags;
    const char* range;
    const char* file; ///< words that write the source
    const char* before;
    const char* after;
    /// Largest difference of a channel: half a code and what halves of EXR round; and of normals what the
    /// rounding of the finest mip, which is made unit, leaves.
    double tolerance;
};

constexpr Kind kKinds[] = {
    {"color", TexelFormat::rgba8_srgb, 0, "min=0.25:max=1", " -d uint8 -o source.png",
     " --colorconvert:unpremult=0 sRGB linear --premult",
     " --unpremult --colorconvert:unpremult=0 linear sRGB", 0.55 / 255 + 5e-4},
    {"data", TexelFormat::rgba8_unorm, 0, "min=0:max=1", " -d uint8 -o source.png", "", "", 0.5 / 255 + 3e-4},
    {"fine data", TexelFormat::rgba16_unorm, 0, "min=0:max=1", " -d uint16 -o source.png", "", "", 3e-4},
    {"normals", TexelFormat::rgba8_unorm, formats::kImageNormalMap, "min=0.51:max=1",
     " -d uint8 -o source.png", " --mulc 2 --subc 1", " --mulc 0.5 --addc 0.5", 1.0 / 255},
    {"light", TexelFormat::rgba16_float, 0, "min=1:max=100", " -d half -o source.exr", "", "", 0.07},
};

/// Return words that divide vectors by their length, for kinds that hold such.
std::string normalize(const Kind& kind)
{
    return kind.flags == formats::kImageNormalMap
               ? " --dup --powc 2 --ch R,G,B --chsum --powc 0.5 --ch 0,0,0,0 --div"
               : "";
}

/// Return oiiotool's word for a size.
std::string sizeWord(uint32_t width, uint32_t height)
{
    return std::to_string(width) + "x" + std::to_string(height);
}

Result<import::DecodedImage> readImage(const Sandbox& folder, const std::string& name)
{
    const std::string bytes = folder.read(name);
    return import::decodeImage(std::as_bytes(std::span(bytes)), name, {});
}

/// Return the mips of an image of the folder, all channels as shares of the full range or as floats.
std::vector<float> makeMips(const ImageRecord& image, const import::DecodedImage& source)
{
    const std::vector<std::byte> chain = textures::buildMipChain(image, source.texels);
    std::vector<float> mips;
    for (const uint32_t number : listChannels({image.width, image.height, source.type, chain}))
        mips.push_back(source.isFloat()
                           ? floatFromHalf(static_cast<uint16_t>(number))
                           : static_cast<float>(number) / (source.channelBytes() == 1 ? 255.f : 65535.f));
    return mips;
}

/// Return oiiotool's words that write each mip but the finest. Each texel becomes as many equal ones as the
/// next mip has texels, so that its box filter averages whole ones, and areas, too, where a size is odd.
std::string writeMips(const ImageRecord& image, const Kind& kind)
{
    std::string words;
    for (uint32_t mip = 1; mip < image.mip_count; ++mip)
    {
        const formats::MipExtent from = formats::mipExtent(image, mip - 1),
                                 to = formats::mipExtent(image, mip);
        words += " --resample:interp=0 " + sizeWord(from.width * to.width, from.height * to.height) +
                 " --resize:filter=box " + sizeWord(to.width, to.height) + " --dup" + normalize(kind) +
                 kind.after + " -d half -o mip" + std::to_string(mip) + ".exr --pop";
    }
    return words;
}

void expectMips(const Kind& kind, uint32_t width, uint32_t height)
{
    Sandbox folder;
    ProgramEnd end =
        runTool(folder, "oiiotool --no-autopremult" + noise(kind.range, 11, 4, sizeWord(width, height)) +
                            " --attrib oiio:UnassociatedAlpha 1" + kind.file);
    ASSERT_EQ(end.exit_code, 0) << end.err << end.out;
    const std::string name = folder.has("source.exr") ? "source.exr" : "source.png";
    const Result<import::DecodedImage> source = readImage(folder, name);
    ASSERT_TRUE(source.ok()) << formatMessage(source.error());
    ImageRecord image{};
    image.width = width;
    image.height = height;
    image.mip_count = textures::fullMipCount(width, height);
    image.format = static_cast<uint32_t>(kind.format);
    image.flags = kind.flags;
    const std::vector<float> mips = makeMips(image, *source);
    end = runTool(folder, "oiiotool --no-autopremult -i:type=float " + name + kind.before + normalize(kind) +
                              writeMips(image, kind));
    ASSERT_EQ(end.exit_code, 0) << end.err << end.out;
    for (uint32_t mip = 1; mip < image.mip_count; ++mip)
    {
        const Result<import::DecodedImage> expected = readImage(folder, "mip" + std::to_string(mip) + ".exr");
        ASSERT_TRUE(expected.ok()) << formatMessage(expected.error());
        const std::vector<uint32_t> halves = listChannels(*expected);
        const size_t first = formats::mipOffset(image, mip) / source->channelBytes();
        ASSERT_EQ(halves.size(), formats::mipOffset(image, mip + 1) / source->channelBytes() - first);
        float difference = 0;
        // the alpha of a normal map is nothing
        for (size_t i = 0; i < halves.size(); ++i)
            if (kind.flags != formats::kImageNormalMap || i % 4 != 3)
                difference = std::max(
                    difference, std::abs(floatFromHalf(static_cast<uint16_t>(halves[i])) - mips[first + i]));
        EXPECT_LE(difference, kind.tolerance) << "mip " << mip;
    }
}

} // namespace

TEST(Oiiotool, agreesAboutMips)
{
    // 16 is halved, 45 becomes areas of texels
    for (const Kind& kind : kKinds)
    {
        SCOPED_TRACE(kind.name);
        expectMips(kind, 45, 16);
    }
}

} // namespace hearth::test
