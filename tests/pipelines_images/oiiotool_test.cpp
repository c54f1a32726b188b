// Compares images that oiiotool has written with what Hearth reads in them, by idiff: a second opinion from
// the programs of OpenImageIO, beside tests that write files byte by byte.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/half.h"
#include "tests/pipelines_images/images_fixture.h"
#include "tests/support/sandbox.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>

#include <sstream>

namespace hearth::test
{

namespace
{

using images::Format;

constexpr int kSide = 64; ///< of all images: the smallest that oiiotool writes as JPEG 2000
constexpr const char* kChannels[] = {"R", "G", "B", "A"};

/// Run a program of OpenImageIO with words that blanks separate.
ProgramEnd runTool(Sandbox& folder, const std::string& words)
{
    std::istringstream stream("/usr/bin/" + words);
    std::vector<std::string> command;
    for (std::string word; stream >> word;)
        command.push_back(word);
    return folder.run(command);
}

/// Decode a file of the folder; shares of the full range, or floats, as RGBA.
std::vector<float> readByHearth(const Sandbox& folder, Format format, const std::string& name,
                                const std::string& layer = {})
{
    const auto image = decode(format, folder.read(name), {.layer = layer});
    if (!image.ok())
    {
        ADD_FAILURE() << name << ": " << formatMessage(image.error());
        return std::vector<float>(size_t{4} * kSide * kSide);
    }
    std::vector<float> texels;
    for (const uint32_t number : listChannels(*image))
        texels.push_back(image->type == import::ChannelType::float16
                             ? floatFromHalf(static_cast<uint16_t>(number))
                             : static_cast<float>(number) / (image->channelBytes() == 1 ? 255.f : 65535.f));
    EXPECT_EQ(texels.size(), size_t{4} * kSide * kSide) << name;
    return texels;
}

/// Write images of RGBA as the parts of an EXR.
void writeParts(const Sandbox& folder, const std::string& name, const std::vector<std::vector<float>>& images)
{
    std::vector<Imf::Header> headers(images.size(), Imf::Header(kSide, kSide));
    for (size_t i = 0; i < images.size(); ++i)
    {
        headers[i].setName("part" + std::to_string(i));
        headers[i].setType(Imf::SCANLINEIMAGE);
        for (const char* channel : kChannels)
            headers[i].channels().insert(channel, Imf::Channel(Imf::FLOAT));
    }
    Imf::MultiPartOutputFile file((folder / name).c_str(), headers.data(), static_cast<int>(headers.size()),
                                  false, 0);
    for (size_t i = 0; i < images.size(); ++i)
    {
        std::vector<float> texels = images[i];
        Imf::FrameBuffer buffer;
        for (size_t c = 0; c < 4; ++c)
            buffer.insert(kChannels[c], Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(texels.data() + c),
                                                   4 * sizeof(float), 4 * sizeof(float) * kSide));
        Imf::OutputPart part(file, static_cast<int>(i));
        part.setFrameBuffer(buffer);
        part.writePixels(kSide);
    }
}

/// Return a file of 16 bits from Photoshop, which oiiotool cannot write.
std::string drawPsd()
{
    PsdImage image{.width = kSide, .height = kSide, .depth = 16, .samples = {}};
    for (uint64_t i = 0; i < uint64_t{3} * kSide * kSide; ++i)
        image.samples.push_back(i * i * 4021 / 3 & 0xFFFF);
    return makePsd(image);
}

std::string noise(const std::string& range, int seed, int channel_count)
{
    return " --pattern noise:type=uniform:" + range + ":seed=" + std::to_string(seed) + " 64x64 " +
           std::to_string(channel_count);
}

} // namespace

TEST(Oiiotool, agreesAboutImages)
{
    Sandbox folder;
    const ProgramEnd written = runTool(
        folder,
        "oiiotool --no-autopremult" + noise("min=0.25:max=1", 1, 4) +
            " --attrib oiio:UnassociatedAlpha 1 -d uint16 -o straight.tif" +
            " --eraseattrib oiio:UnassociatedAlpha --premult -o multiplied.tif" + noise("min=0:max=1", 2, 3) +
            " -d uint8 --compression lzw -o:tile=16x16:separate=1 tiles.tif" + noise("min=0:max=1", 3, 3) +
            " -d uint16 -o rgb.jp2" + noise("min=0:max=1", 4, 4) +
            " --attrib tiff:ColorSpace CMYK --attrib tiff:PhotometricInterpretation 5 -d uint8 -o ink.tif" +
            noise("min=0:max=9", 5, 3) + " --attrib oiio:subimagename beauty" + noise("min=0:max=9", 6, 3) +
            " --attrib oiio:subimagename light --siappend -d half -o parts.exr");
    ASSERT_EQ(written.exit_code, 0) << written.err << written.out;
    folder.write("rgb.psd", drawPsd());

    const std::string opaque = " --ch R,G,B,A=1 ", ink = " -i:type=float ink.tif";
    const ProgramEnd read = runTool(
        folder, "oiiotool --no-autopremult straight.tif multiplied.tif --unpremult tiles.tif" + opaque +
                    "rgb.jp2" + opaque + "rgb.psd" + opaque + "parts.exr --subimage light" + opaque +
                    "--siappendall -d float -o expected.exr" + ink + " --ch R=ink0,G=ink1,B=ink2 --invert" +
                    ink + " --ch R=ink3,G=ink3,B=ink3 --invert --mul" + opaque + "-o expected-ink.exr");
    ASSERT_EQ(read.exit_code, 0) << read.err << read.out;

    writeParts(folder, "read.exr",
               {readByHearth(folder, Format::tiff, "straight.tif"),
                readByHearth(folder, Format::tiff, "multiplied.tif"),
                readByHearth(folder, Format::tiff, "tiles.tif"),
                readByHearth(folder, Format::jpeg2000, "rgb.jp2"),
                readByHearth(folder, Format::psd, "rgb.psd"),
                readByHearth(folder, Format::exr, "parts.exr", "light")});
    writeParts(folder, "read-ink.exr", {readByHearth(folder, Format::tiff, "ink.tif")});
    // half a code, of 16 bits where alpha is taken away, and of 8 bits where ink becomes light
    for (const char* words : {"idiff -a -fail 8e-6 -warn 8e-6 expected.exr read.exr",
                              "idiff -fail 0.002 -warn 0.002 expected-ink.exr read-ink.exr"})
    {
        const ProgramEnd compared = runTool(folder, words);
        EXPECT_EQ(compared.exit_code, 0) << words << "\n" << compared.out << compared.err;
    }
}

} // namespace hearth::test
