// Checks that ktx-parse, an independent reader, finds in written KTX2 files what the specifications ask for.
// Sources: Khronos KTX File Format Specification 2.0; Khronos Data Format Specification 1.4, chapter 24,
// "Compressed Texture Format Descriptors"; the list of VkFormat.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/texture_files/ktx2_writer.h"
#include "tests/support/sandbox.h"

#include <gtest/gtest.h>

#include <zstd.h>

#include <cstdlib>
#include <sstream>

namespace hearth::texture_files
{

namespace
{

using namespace formats;

/// Expected content of the files of a format, from the specifications.
struct Expected
{
    const char* format; ///< Hearth's name
    uint32_t vk_format;
    uint32_t block_width, block_height, block_bytes;
    uint32_t model;
    uint32_t transfer;   ///< 1 linear, 2 sRGB
    const char* samples; ///< each: first bit, bits - 1, channel with qualifiers, lower, upper
    const char* swizzle = "rgba";
    uint32_t type_bytes = 1;
};

constexpr const char* kUnorm128 = "[0,127,0,0,4294967295]";
constexpr const char* kUnorm64 = "[0,63,0,0,4294967295]";

constexpr Expected kExpected[] = {
    {"astc-4x4-unorm", 157, 4, 4, 16, 162, 1, kUnorm128, "ra01"},
    {"astc-4x4-srgb", 158, 4, 4, 16, 162, 2, kUnorm128},
    {"astc-6x5-srgb", 164, 6, 5, 16, 162, 2, kUnorm128},
    {"astc-12x10-unorm", 181, 12, 10, 16, 162, 1, kUnorm128, "rrr1"},
    {"astc-8x8-float", 1000066007, 8, 8, 16, 162, 1, "[0,127,192,-1082130432,1065353216]"},
    {"etc2-rgb8-unorm", 147, 4, 4, 8, 161, 1, "[0,63,2,0,4294967295]"},
    {"etc2-rgb8-srgb", 148, 4, 4, 8, 161, 2, "[0,63,2,0,4294967295]"},
    {"etc2-rgba8-srgb", 152, 4, 4, 16, 161, 2, "[0,63,31,0,4294967295],[64,63,2,0,4294967295]"},
    {"eac-r11-unorm", 153, 4, 4, 8, 161, 1, kUnorm64},
    {"eac-rg11-unorm", 155, 4, 4, 16, 161, 1, "[0,63,0,0,4294967295],[64,63,1,0,4294967295]", "rg01"},
    {"bc1-rgb-unorm", 131, 4, 4, 8, 128, 1, kUnorm64},
    {"bc1-rgb-srgb", 132, 4, 4, 8, 128, 2, kUnorm64},
    {"bc3-srgb", 138, 4, 4, 16, 130, 2, "[0,63,31,0,4294967295],[64,63,0,0,4294967295]"},
    {"bc4-unorm", 139, 4, 4, 8, 131, 1, kUnorm64},
    {"bc5-unorm", 141, 4, 4, 16, 132, 1, "[0,63,0,0,4294967295],[64,63,1,0,4294967295]", "rg01"},
    {"bc6h-ufloat", 143, 4, 4, 16, 133, 1, "[0,127,128,0,1065353216]"},
    {"bc7-unorm", 145, 4, 4, 16, 134, 1, kUnorm128},
    {"bc7-srgb", 146, 4, 4, 16, 134, 2, kUnorm128},
    {"r8-unorm", 9, 1, 1, 1, 1, 1, "[0,7,0,0,255]"},
    {"rg8-unorm", 16, 1, 1, 2, 1, 1, "[0,7,0,0,255],[8,7,1,0,255]"},
    {"rgba8-srgb", 43, 1, 1, 4, 1, 2, "[0,7,0,0,255],[8,7,1,0,255],[16,7,2,0,255],[24,7,31,0,255]"},
    {"rgba8-unorm", 37, 1, 1, 4, 1, 1, "[0,7,0,0,255],[8,7,1,0,255],[16,7,2,0,255],[24,7,15,0,255]"},
    {"rgba16-float", 97, 1, 1, 8, 1, 1,
     "[0,15,192,-1082130432,1065353216],[16,15,193,-1082130432,1065353216],"
     "[32,15,194,-1082130432,1065353216],[48,15,207,-1082130432,1065353216]",
     "rgba", 2},
    {"rgb9e5-float", 123, 1, 1, 4, 1, 1,
     "[0,8,0,0,8448],[27,4,32,15,31],[9,8,1,0,8448],[27,4,33,15,31],[18,8,2,0,8448],[27,4,34,15,31]", "rgba",
     4},
};

struct Shape
{
    uint32_t width, height, mip_count;
};

constexpr Shape kShapes[] = {{37, 21, 6}, {16, 64, 1}, {1, 1, 1}};

/// Return the bytes of each mip.
std::vector<size_t> listMipBytes(const Expected& expected, const Shape& shape)
{
    std::vector<size_t> sizes;
    for (uint32_t mip = 0; mip < shape.mip_count; ++mip)
    {
        const uint32_t width = std::max(1u, shape.width >> mip), height = std::max(1u, shape.height >> mip);
        sizes.push_back(size_t{(width + expected.block_width - 1) / expected.block_width} *
                        ((height + expected.block_height - 1) / expected.block_height) *
                        expected.block_bytes);
    }
    return sizes;
}

std::string join(const std::vector<size_t>& numbers)
{
    std::string text;
    for (const size_t number : numbers)
        text += (text.empty() ? "" : ",") + std::to_string(number);
    return text;
}

/// Return the line that print_ktx2.mjs should print.
std::string expectedLine(const Expected& expected, const Shape& shape, bool is_compressed)
{
    std::ostringstream line;
    line << R"({"vkFormat":)" << expected.vk_format << R"(,"typeSize":)" << expected.type_bytes
         << R"(,"size":[)" << shape.width << ',' << shape.height << R"(,0,0,1],"scheme":)"
         << (is_compressed ? 2 : 0) << R"(,"levels":[)" << join(listMipBytes(expected, shape))
         << R"(],"model":)" << expected.model << R"(,"primaries":1,"transfer":)" << expected.transfer
         << R"(,"flags":0,"block":[)" << expected.block_width - 1 << ',' << expected.block_height - 1
         << R"(,0,0],"bytes":[)" << expected.block_bytes << R"(,0,0,0,0,0,0,0],"samples":[)"
         << expected.samples << R"(],"keys":{"KTXorientation":"rd",)";
    if (std::string(expected.swizzle) != "rgba")
        line << R"("KTXswizzle":")" << expected.swizzle << R"(",)";
    line << R"("KTXwriter":"Hearth test"}})";
    return line.str();
}

std::string drawMips(const Expected& expected, const Shape& shape)
{
    std::string mips;
    for (const size_t size : listMipBytes(expected, shape))
        for (size_t i = 0; i < size; ++i)
            mips += static_cast<char>(mips.size() * mips.size() / 7 + mips.size());
    return mips;
}

/// Return the text of zstd frames that follow each other.
std::string decompress(const std::string& frames, size_t size)
{
    std::string text(size, '\0');
    const size_t read = ZSTD_decompress(text.data(), size, frames.data(), frames.size());
    EXPECT_EQ(ZSTD_isError(read), 0u) << ZSTD_getErrorName(read);
    return text;
}

struct WrittenFile
{
    std::string name;
    std::string mips;
    std::string line; ///< expected
    bool is_compressed;
};

/// Write files of all formats, shapes and schemes.
std::vector<WrittenFile> writeFiles(const test::Sandbox& folder)
{
    std::vector<WrittenFile> files;
    for (const Expected& expected : kExpected)
        for (const Shape& shape : kShapes)
            for (const bool is_compressed : {false, true})
            {
                const std::string mips = drawMips(expected, shape);
                const std::vector<std::byte> bytes =
                    writeKtx2({findTexelFormat(expected.format), shape.width, shape.height, shape.mip_count,
                               std::as_bytes(std::span(mips)), expected.swizzle},
                              "Hearth test", is_compressed);
                const std::string name = std::string(expected.format) + "-" + std::to_string(files.size());
                folder.write(name, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
                files.push_back({name, mips, expectedLine(expected, shape, is_compressed), is_compressed});
            }
    return files;
}

} // namespace

TEST(KtxParse, readsWhatTheSpecificationsAskFor)
{
    const char* const module = std::getenv("HEARTH_KTX_PARSE");
    if (module == nullptr)
        GTEST_SKIP() << "there is no ktx-parse: ./dev test installs it by npm and sets HEARTH_KTX_PARSE";
    test::Sandbox folder;
    const std::vector<WrittenFile> files = writeFiles(folder);
    std::vector<std::string> command = {"/usr/bin/env", "node", HEARTH_PRINT_KTX2, module};
    for (const WrittenFile& file : files)
        command.push_back(file.name);
    const test::ProgramEnd end = folder.run(command);
    ASSERT_EQ(end.exit_code, 0) << end.err;

    std::istringstream lines(end.out);
    for (const WrittenFile& file : files)
    {
        std::string line;
        std::getline(lines, line);
        EXPECT_EQ(line, file.line) << file.name;
        const std::string levels = folder.read(file.name + ".levels");
        EXPECT_TRUE((file.is_compressed ? decompress(levels, file.mips.size()) : levels) == file.mips)
            << file.name;
    }
}

} // namespace hearth::texture_files
