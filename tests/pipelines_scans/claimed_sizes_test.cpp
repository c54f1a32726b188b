// Decodes files of a few bytes whose headers claim much memory.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/pipelines_scans/dds_builder.h"
#include "tests/pipelines_scans/scan_test_tools.h"
#include "tests/support/limits/peak_memory.h"

#include <gtest/gtest.h>

namespace hearth::import
{

namespace
{

using namespace hearth::test;
using namespace hearth::import::test;

// what a decoder may take beside the image: tables, buffers of rows and messages
constexpr int kMaxPeak_mib = 24;
constexpr uint32_t kSide = 8192; ///< of the largest image that is read
constexpr uint32_t kMaxPngClaim = 0x7FFFFFFF;
constexpr uint32_t kExrClaim = 1u << 30;

Bytes fromText(std::string_view text)
{
    return {text.begin(), text.end()};
}

void appendText(Bytes& bytes, std::string_view text)
{
    bytes.insert(bytes.end(), text.begin(), text.end());
}

void appendBigEndian(Bytes& bytes, uint32_t value, size_t size = 4)
{
    for (size_t i = size; i-- > 0;)
        bytes.push_back(static_cast<uint8_t>(value >> (8 * i)));
}

/// Return the checksum of PNG.
uint32_t computeCrc(std::span<const uint8_t> bytes)
{
    uint32_t crc = ~0u;
    for (const uint8_t byte : bytes)
    {
        crc ^= byte;
        for (int i = 0; i < 8; ++i)
            crc = crc >> 1 ^ ((crc & 1u) != 0 ? 0xEDB88320u : 0u);
    }
    return ~crc;
}

/// PNG of RGBA8 with nothing behind its header.
Bytes pngHeader(uint32_t side)
{
    Bytes bytes = fromText("\x89PNG\r\n\x1A\n");
    appendBigEndian(bytes, 13);
    appendText(bytes, "IHDR");
    appendBigEndian(bytes, side);
    appendBigEndian(bytes, side);
    bytes.insert(bytes.end(), {8, 6, 0, 0, 0});
    appendBigEndian(bytes, computeCrc(std::span(bytes).subspan(12)));
    return bytes;
}

Bytes pngWithClaim(std::string_view chunk)
{
    Bytes bytes = pngHeader(1);
    appendBigEndian(bytes, kMaxPngClaim);
    appendText(bytes, chunk);
    bytes.insert(bytes.end(), 3, 0);
    return bytes;
}

/// PNG of kSide with an image chunk of one byte.
Bytes shortPng()
{
    Bytes bytes = pngHeader(kSide);
    appendBigEndian(bytes, 1);
    const size_t start = bytes.size();
    appendText(bytes, "IDAT");
    bytes.push_back(0x78);
    appendBigEndian(bytes, computeCrc(std::span(bytes).subspan(start)));
    return bytes;
}

Bytes progressiveJpeg()
{
    Bytes bytes = {0xFF, 0xD8, 0xFF, 0xC2, 0, 17, 8};
    appendBigEndian(bytes, kSide, 2);
    appendBigEndian(bytes, kSide, 2);
    bytes.insert(bytes.end(), {3, 1, 0x11, 0, 2, 0x11, 0, 3, 0x11, 0});
    bytes.insert(bytes.end(), {0xFF, 0xDA, 0, 12, 3, 1, 0, 2, 0, 3, 0, 0, 0, 0});
    return bytes;
}

Bytes lossyWebp()
{
    Bytes bytes = fromText("RIFF");
    append(bytes, 4 + 8 + 400, 4);
    appendText(bytes, "WEBPVP8 ");
    append(bytes, 400, 4);
    append(bytes, 0x10 | 100 << 5, 3); // key frame that is shown, first partition of 100 bytes
    bytes.insert(bytes.end(), {0x9D, 0x01, 0x2A});
    append(bytes, kSide, 2);
    append(bytes, kSide, 2);
    bytes.resize(20 + 400);
    return bytes;
}

Bytes tga(uint8_t type)
{
    Bytes bytes = {0, 0, type, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    append(bytes, kSide, 2);
    append(bytes, kSide, 2);
    bytes.insert(bytes.end(), {32, 0});
    return bytes;
}

/// HDR that is as long as its texels at 32768 a byte.
Bytes shortHdr()
{
    Bytes bytes = fromText("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8192 +X 8192\n");
    bytes.resize(2200);
    return bytes;
}

Bytes exrWithAttribute(std::string_view type, uint32_t size, uint32_t inner_size)
{
    Bytes bytes = {0x76, 0x2F, 0x31, 0x01, 2, 0, 0, 0};
    appendText(bytes, "name");
    bytes.push_back(0);
    appendText(bytes, type);
    bytes.push_back(0);
    append(bytes, size, 4);
    append(bytes, inner_size, 4);
    append(bytes, 1, 4);
    return bytes;
}

/// Zstandard frame that claims `size` bytes and has one.
Bytes claimingFrame(uint64_t size)
{
    Bytes bytes = {0x28, 0xB5, 0x2F, 0xFD, 0xE0};
    append(bytes, size, 8);
    bytes.insert(bytes.end(), {0x0B, 0, 0, 0});
    return bytes;
}

Bytes claimingKtx2()
{
    constexpr uint64_t kTexelBytes = uint64_t{4} * kSide * kSide;
    return Ktx2{.width = kSide,
                .height = kSide,
                .scheme = 2,
                .levels = {claimingFrame(kTexelBytes)},
                .uncompressed = {kTexelBytes}}
        .file();
}

Bytes claimingDds()
{
    Dds dds = Dds::withDxgi(99, Bytes(64));
    dds.width = dds.height = kSide;
    return dds.file();
}

Bytes claimingKtx2OfZlib()
{
    constexpr uint64_t kTexelBytes = uint64_t{4} * kSide * kSide;
    const Bytes stream = {0x78, 0x9C, 0x63, 0, 0, 0, 1, 0, 1}; // of one byte
    return Ktx2{
        .width = kSide, .height = kSide, .scheme = 3, .levels = {stream}, .uncompressed = {kTexelBytes}}
        .file();
}

struct SmallImage
{
    std::string name;
    Bytes bytes;
};

std::vector<SmallImage> smallImages()
{
    return {{"PNG whose colour profile claims 2 GiB", pngWithClaim("iCCP")},
            {"PNG whose text claims 2 GiB", pngWithClaim("iTXt")},
            {"PNG whose unknown chunk claims 2 GiB", pngWithClaim("abCd")},
            {"PNG without texels", shortPng()},
            {"progressive JPEG without texels", progressiveJpeg()},
            {"lossy WebP without texels", lossyWebp()},
            {"TGA without texels", tga(2)},
            {"TGA without runs", tga(10)},
            {"HDR without runs", shortHdr()},
            {"EXR whose text claims 1 GiB", exrWithAttribute("string", kExrClaim, 0)},
            {"EXR whose preview claims 1 GiB", exrWithAttribute("preview", 8, kExrClaim / 4)},
            {"EXR whose list claims 1 GiB", exrWithAttribute("stringvector", 8, kExrClaim)},
            {"KTX2 whose level claims 256 MiB", claimingKtx2()},
            {"KTX2 whose zlib level claims 256 MiB", claimingKtx2OfZlib()},
            {"DDS without texels", Dds{.width = kSide, .height = kSide}.file()},
            {"DDS without blocks", claimingDds()}};
}

TEST(ClaimedSizes, ofImagesTakeNoMemory)
{
    for (const SmallImage& image : smallImages())
    {
        ASSERT_LT(image.bytes.size(), 4096u) << image.name;
        const auto refused = [&]
        {
            const auto decoded = decode(image.bytes);
            return !decoded.ok() && decoded.error().issue == Issue::image_malformed;
        };
        const std::optional<int> peak_mib = measurePeak_mib(refused);
        EXPECT_TRUE(peak_mib.has_value()) << image.name << ": is read, or refused for another reason";
        EXPECT_LE(peak_mib.value_or(0), kMaxPeak_mib) << image.name;
    }
}

void appendVarint(Bytes& bytes, uint64_t value)
{
    for (; value >= 0x80; value >>= 7)
        bytes.push_back(static_cast<uint8_t>(value | 0x80));
    bytes.push_back(static_cast<uint8_t>(value));
}

Bytes dracoHeader(uint8_t type, uint8_t method, uint16_t flags = 0)
{
    Bytes bytes = fromText("DRACO");
    bytes.insert(bytes.end(), {2, 2, type, method});
    append(bytes, flags, 2);
    return bytes;
}

/// One attribute of three floats, coded plainly and without values.
void appendPositions(Bytes& bytes)
{
    bytes.insert(bytes.end(), {1, 1, 0, 9, 3, 0, 0, 0});
}

constexpr uint32_t kManyPoints = uint32_t{1} << 26;

Bytes sequentialMesh(uint16_t flags)
{
    Bytes bytes = dracoHeader(1, 0, flags);
    if (flags != 0)
        bytes.insert(bytes.end(), {0, 0, 0}); // metadata: none of attributes, no entries, no children
    appendVarint(bytes, 1);
    appendVarint(bytes, kManyPoints);
    bytes.push_back(1); // indices are not compressed
    append(bytes, 0, 3 * sizeof(uint32_t));
    appendPositions(bytes);
    return bytes;
}

Bytes edgebreakerMesh()
{
    Bytes bytes = dracoHeader(1, 1);
    bytes.push_back(0);
    appendVarint(bytes, kManyPoints / 2);
    appendVarint(bytes, kManyPoints);
    bytes.push_back(0);
    appendVarint(bytes, kManyPoints);
    appendVarint(bytes, 0);
    bytes.insert(bytes.end(), 8, 0);
    return bytes;
}

Bytes sequentialCloud()
{
    Bytes bytes = dracoHeader(0, 0);
    append(bytes, kManyPoints, 4);
    appendPositions(bytes);
    return bytes;
}

TEST(ClaimedSizes, ofDracoTakeNoMemory)
{
    for (const auto& [name, bytes] : {SmallImage{"mesh of sequential coding", sequentialMesh(0)},
                                      {"mesh with metadata", sequentialMesh(0x8000)},
                                      {"mesh of Edgebreaker coding", edgebreakerMesh()},
                                      {"cloud of points", sequentialCloud()}})
    {
        const auto refused = [&]
        {
            const std::string text(bytes.begin(), bytes.end());
            const auto mesh = readText(readDrc, text);
            return !mesh.ok() && mesh.error().issue == Issue::codec_failed;
        };
        const std::optional<int> peak_mib = measurePeak_mib(refused);
        EXPECT_TRUE(peak_mib.has_value()) << name;
        EXPECT_LE(peak_mib.value_or(0), kMaxPeak_mib) << name;
    }
}

} // namespace

} // namespace hearth::import
