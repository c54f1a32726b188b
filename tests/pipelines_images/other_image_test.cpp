// Tests JPEG 2000, parts and layers of EXR, and ICC profiles.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/pipelines_images/frozen_jpeg2000.h"
#include "tests/pipelines_images/images_fixture.h"
#include "tests/support/sandbox.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <lcms2.h>

#include <cmath>

namespace hearth::test
{

namespace
{

constexpr auto kExr = images::Format::exr;

template <size_t size>
std::string makeText(const uint8_t (&bytes)[size])
{
    return {reinterpret_cast<const char*>(bytes), size};
}

TEST(Jpeg2000Images, keepTheirNumbers)
{
    Numbers rgb, grey, rgba;
    for (uint32_t i = 0; i < 9 * 7; ++i)
        for (uint32_t c = 0; c < 4; ++c)
        {
            rgb.push_back(c == 3 ? 255 : (37 * i + 11 * c) % 256);
            rgba.push_back(c == 3 ? (3 * i + 33) % 256 : rgb.back());
            grey.push_back(c == 3 ? 65535 : (1031 * i + 7) % 65536);
        }
    expectTexels(images::Format::jpeg2000, makeText(kRgb8), rgb);
    expectTexels(images::Format::jpeg2000, makeText(kRgba8), rgba);
    expectTexels(images::Format::jpeg2000, makeText(kGrey16), grey);
}

struct Part
{
    std::string name;
    std::vector<std::string> channels;
};

/// Write a file of 2 x 1 texels; the halves of the file count from 0x3000.
std::string makeExr(const std::vector<Part>& parts)
{
    const Sandbox folder;
    {
        std::vector<Imf::Header> headers;
        for (const Part& part : parts)
        {
            Imf::Header header(2, 1);
            header.setName(part.name);
            header.setType(Imf::SCANLINEIMAGE);
            for (const std::string& channel : part.channels)
                header.channels().insert(channel, Imf::Channel(Imf::HALF));
            headers.push_back(header);
        }
        Imf::MultiPartOutputFile file((folder / "a.exr").c_str(), headers.data(),
                                      static_cast<int>(headers.size()), false, 0);
        uint16_t next = 0x3000;
        for (size_t i = 0; i < parts.size(); ++i)
        {
            std::vector<uint16_t> halves;
            for (size_t k = 0; k < 2 * parts[i].channels.size(); ++k)
                halves.push_back(next++);
            Imf::FrameBuffer buffer;
            for (size_t c = 0; c < parts[i].channels.size(); ++c)
                buffer.insert(parts[i].channels[c],
                              Imf::Slice(Imf::HALF, reinterpret_cast<char*>(halves.data() + 2 * c), 2, 4));
            Imf::OutputPart part(file, static_cast<int>(i));
            part.setFrameBuffer(buffer);
            part.writePixels(1);
        }
    }
    return folder.read("a.exr");
}

TEST(ExrImages, areThePartOrTheLayerThatIsNamed)
{
    const std::string file = makeExr({{"depth", {"Z"}},                                  // 3000
                                      {"beauty", {"R", "G", "B", "A"}},                  // 3002
                                      {"light", {"sun.R", "sun.G", "sun.B", "sky.Y"}}}); // 300A
    const Numbers beauty{0x3002, 0x3004, 0x3006, 0x3008, 0x3003, 0x3005, 0x3007, 0x3009};
    const Numbers sun{0x300A, 0x300C, 0x300E, 0x3C00, 0x300B, 0x300D, 0x300F, 0x3C00};
    const Numbers sky{0x3010, 0x3010, 0x3010, 0x3C00, 0x3011, 0x3011, 0x3011, 0x3C00};
    const std::string all = "layers beside 'beauty' are not kept: depth, light, sky, sun";
    expectTexels(kExr, file, beauty, {"W1305 " + all});
    expectTexels(kExr, file, beauty, {"W1305 " + all}, {.layer = "beauty"});
    expectTexels(kExr, file, sun, {"W1305 layers beside 'sun' are not kept: depth, beauty, light, sky"},
                 {.layer = "sun"});
    expectTexels(kExr, file, sky, {"W1305 layers beside 'sky' are not kept: depth, beauty, light, sun"},
                 {.layer = "sky"});
    expectTexels(kExr, file, beauty,
                 {"W1305 it has no layer 'moon', but depth, beauty, light, sky, sun", "W1305 " + all},
                 {.layer = "moon"});
    expectRefused(kExr, makeExr({{"depth", {"Z"}}, {"N", {"X"}}}), Issue::image_unsupported,
                  "none of its parts has channels R, G and B, or Y");
}

/// Return the bytes of a profile.
std::string saveProfile(cmsHPROFILE profile)
{
    cmsUInt32Number size = 0;
    cmsSaveProfileToMem(profile, nullptr, &size);
    std::string bytes(size, '\0');
    cmsSaveProfileToMem(profile, bytes.data(), &size);
    cmsCloseProfile(profile);
    return bytes;
}

/// Return the profile of sRGB with red and green exchanged.
std::string makeSwappedProfile()
{
    const cmsCIExyY white{0.3127, 0.3290, 1};
    const cmsCIExyYTRIPLE primaries{{0.30, 0.60, 1}, {0.64, 0.33, 1}, {0.15, 0.06, 1}};
    const cmsFloat64Number curve[5] = {2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045};
    cmsToneCurve* tone = cmsBuildParametricToneCurve(nullptr, 4, curve);
    cmsToneCurve* const tones[3] = {tone, tone, tone};
    const std::string bytes = saveProfile(cmsCreateRGBProfile(&white, &primaries, tones));
    cmsFreeToneCurve(tone);
    return bytes;
}

TEST(IccProfiles, areUsedWhereThatIsAsked)
{
    TiffImage image{.width = 2, .height = 1, .samples = {10, 200, 90, 255, 0, 31}, .channel_count = 3};
    image.profile = makeSwappedProfile();
    for (const uint32_t bits : {8u, 16u})
    {
        image.bits = bits;
        image.samples = {10, 200, 90, 255, 0, 31};
        if (bits == 16)
            for (uint64_t& sample : image.samples)
                sample *= 257;
        Numbers kept;
        for (size_t i = 0; i < 6; ++i)
        {
            kept.push_back(static_cast<uint32_t>(image.samples[i]));
            if (i % 3 == 2)
                kept.push_back((1u << bits) - 1);
        }
        expectTexels(images::Format::tiff, makeTiff({image}), kept);
        const auto converted = decode(images::Format::tiff, makeTiff({image}), {.convert_icc = true});
        ASSERT_TRUE(converted.ok()) << formatMessage(converted.error());
        const Numbers texels = listChannels(*converted);
        for (size_t i = 0; i < 8; ++i)
            EXPECT_NEAR(texels[i],
                        kept[i % 4 == 0   ? i + 1
                             : i % 4 == 1 ? i - 1
                                          : i],
                        bits == 8 ? 1 : 60)
                << i;
    }
    image.profile.resize(200);
    EXPECT_EQ(listNotes(*decode(images::Format::tiff, makeTiff({image}), {.convert_icc = true})),
              Notes{"W1307 its ICC profile is damaged, or of other colours than the image"});
}

/// Colours of an imagined printer: cyan ink is black, the others are invisible.
cmsInt32Number printCyanAsBlack(const cmsUInt16Number in[], cmsUInt16Number out[], void* to_lab)
{
    const auto light = static_cast<uint16_t>(65535 - in[0]);
    const uint16_t rgb[3] = {light, light, light};
    cmsDoTransform(to_lab, rgb, out, 1);
    return 1;
}

std::string makePrinterProfile()
{
    cmsHPROFILE srgb = cmsCreate_sRGBProfile();
    cmsHPROFILE lab = cmsCreateLab2Profile(nullptr);
    cmsHTRANSFORM to_lab =
        cmsCreateTransform(srgb, TYPE_RGB_16, lab, TYPE_LabV2_16, INTENT_RELATIVE_COLORIMETRIC,
                           cmsFLAGS_NOOPTIMIZE | cmsFLAGS_NOCACHE);
    cmsPipeline* pipeline = cmsPipelineAlloc(nullptr, 4, 3);
    cmsStage* table = cmsStageAllocCLut16bit(nullptr, 9, 4, 3, nullptr);
    cmsStageSampleCLut16bit(table, printCyanAsBlack, to_lab, 0);
    cmsPipelineInsertStage(pipeline, cmsAT_END, table);
    cmsHPROFILE profile = cmsCreateProfilePlaceholder(nullptr);
    cmsSetProfileVersion(profile, 2.1);
    cmsSetDeviceClass(profile, cmsSigOutputClass);
    cmsSetColorSpace(profile, cmsSigCmykData);
    cmsSetPCS(profile, cmsSigLabData);
    cmsWriteTag(profile, cmsSigAToB0Tag, pipeline);
    cmsWriteTag(profile, cmsSigAToB1Tag, pipeline);
    cmsPipelineFree(pipeline);
    cmsDeleteTransform(to_lab);
    cmsCloseProfile(lab);
    cmsCloseProfile(srgb);
    return saveProfile(profile);
}

TEST(IccProfiles, turnInkIntoColours)
{
    // by the plain formula these would be cyan, magenta and half yellow
    TiffImage tiff{.width = 3, .height = 1, .photometric = 5, .channel_count = 4};
    tiff.samples = {255, 0, 0, 0, 0, 255, 0, 0, 0, 0, 128, 0};
    tiff.profile = makePrinterProfile();
    PsdImage psd{.width = 3, .height = 1, .mode = 4, .channel_count = 4, .profile = tiff.profile};
    psd.samples = {0, 255, 255, 255, 0, 255, 255, 255, 127, 255, 255, 255};
    const Numbers expected{0, 0, 0, 255, 255, 255, 255, 255, 255, 255, 255, 255};
    expectTexels(images::Format::tiff, makeTiff({tiff}), expected);
    expectTexels(images::Format::psd, makePsd(psd), expected);
}

} // namespace

} // namespace hearth::test
