// Compares images that oiiotool has written with what Hearth reads in them, by idiff: a second opinion from
// the programs of OpenImageIO, beside tests that write files byte by byte.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/half.h"
#include "pipelines/import/images/decode.h"
#include "tests/pipelines_images/images_fixture.h"
#include "tests/pipelines_images/oiiotool.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>

namespace hearth::test
{

namespace
{

using images::Format;

constexpr int kSide = 64; ///< of all images: the smallest that oiiotool writes as JPEG 2000
constexpr const char* kChannels[] = {"R", "G", "B", "A"};

/// Return the texels of a decoded file: shares of the full range, or floats, as RGBA.
std::vector<float> listTexels(const std::string& name, const Result<import::DecodedImage>& image)
{
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

/// Decode a file of the folder by hearth-images.
std::vector<float> readByHearth(const Sandbox& folder, Format format, const std::string& name,
                                const std::string& layer = {})
{
    return listTexels(name, decode(format, folder.read(name), {.layer = layer}));
}

/// Decode a file of the folder by the importer alone.
std::vector<float> readByImporter(const Sandbox& folder, const std::string& name)
{
    const std::string bytes = folder.read(name);
    return listTexels(name, import::decodeImage(std::as_bytes(std::span(bytes)), name, {}));
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

TEST(Oiiotool, agreesAboutImagesOfEachDecoderOfTheImporter)
{
    // largest difference: halves of HDR and EXR beside floats, and the rounding of a JPEG's inverse transform
    struct Row
    {
        const char* name;
        const char* written; ///< words of oiiotool
        double tolerance;
    };
    const std::string colors = noise("min=0:max=1", 7, 4), opaque = noise("min=0:max=1", 8, 3),
                      bright = noise("min=0.01:max=100", 9, 3);
    const Row rows[] = {
        {"eight.png", " -d uint8 -o eight.png", 1e-6},
        {"sixteen.png", " -d uint16 -o sixteen.png", 1e-6},
        {"lossless.webp", " -d uint8 --compression lossless:100 -o lossless.webp", 1e-6},
        {"runs.tga", " -d uint8 --compression rle -o runs.tga", 1e-6},
        {"plain.tga", " -d uint8 --compression none -o plain.tga", 1e-6},
        {"plain.bmp", " -d uint8 -o plain.bmp", 1e-6},
        {"fine.jpg", " -d uint8 --compression jpeg:98 -o fine.jpg", 1.5 / 255},
        {"light.hdr", " -o light.hdr", 0.06},
        {"zip.exr", " -d half --compression zip -o zip.exr", 1e-6},
        {"piz.exr", " -d half --compression piz -o piz.exr", 1e-6},
        {"floats.exr", " -d float --compression rle -o floats.exr", 0.04},
    };
    Sandbox folder;
    std::string write = "oiiotool --no-autopremult", read = write;
    for (const Row& row : rows)
    {
        const std::string name = row.name;
        const bool is_bright = name.ends_with(".hdr") || name.ends_with(".exr");
        // oiiotool multiplies the colours of WebP by their alpha in any case
        const bool is_opaque =
            is_bright || name.ends_with(".jpg") || name.ends_with(".bmp") || name.ends_with(".webp");
        write += (is_bright   ? bright
                  : is_opaque ? opaque
                              : colors + " --attrib oiio:UnassociatedAlpha 1") +
                 row.written;
        read += " " + name + (is_opaque ? " --ch R,G,B,A=1" : "") + " -d float -o " + name + ".expected.exr";
    }
    for (const std::string& words : {write, read})
    {
        const ProgramEnd end = runTool(folder, words);
        ASSERT_EQ(end.exit_code, 0) << words << end.err << end.out;
    }
    for (const Row& row : rows)
    {
        writeParts(folder, "read.exr", {readByImporter(folder, row.name)});
        const std::string tolerance = std::to_string(row.tolerance);
        const ProgramEnd compared = runTool(folder, "idiff -fail " + tolerance + " -warn " + tolerance + " " +
                                                        row.name + ".expected.exr read.exr");
        EXPECT_EQ(compared.exit_code, 0) << row.name << "\n" << compared.out << compared.err;
    }
}

} // namespace hearth::test
