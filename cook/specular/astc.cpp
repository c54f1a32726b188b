// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/specular/astc.h"

#include "formats/base/assert.h"

#include <algorithm>
#include <astcenc.h>
#include <memory>

namespace hearth::specular
{

namespace
{

constexpr uint32_t kTableNodes = shared::kSpecularNodes;
constexpr uint32_t kWidth = kTableNodes * kTableNodes, kHeight = kTableNodes;
constexpr size_t kBlockBytes = 16;

struct FreeContext
{
    void operator()(astcenc_context* context) const { astcenc_context_free(context); }
};
using Context = std::unique_ptr<astcenc_context, FreeContext>;

/// Create a context for one thread: all blocks take a tenth of a second. The exhaustive search takes four
/// times as long, and its errors are a tenth smaller.
Context createContext(uint32_t block)
{
    astcenc_config config{};
    const astcenc_error configured =
        astcenc_config_init(ASTCENC_PRF_LDR, block, block, 1, ASTCENC_PRE_THOROUGH, 0, &config);
    HEARTH_ASSERT(configured == ASTCENC_SUCCESS);
    astcenc_context* context = nullptr;
    const astcenc_error allocated = astcenc_context_alloc(&config, 1, &context);
    HEARTH_ASSERT(allocated == ASTCENC_SUCCESS);
    return Context(context);
}

/// Compute the index of a node's texel in the image.
size_t nodeTexel(size_t node)
{
    const size_t aperture = node % kTableNodes, roughness = node / kTableNodes % kTableNodes,
                 beta = node / (kTableNodes * kTableNodes);
    return roughness * kWidth + beta * kTableNodes + aperture;
}

size_t blocksAlong(uint32_t texels, uint32_t block)
{
    return (texels + block - 1) / block;
}

} // namespace

AstcTable encodeAstc(const TableValues& values, uint32_t block)
{
    HEARTH_ASSERT(std::find(kAstcBlocks.begin(), kAstcBlocks.end(), block) != kAstcBlocks.end());
    std::vector<float> texels(size_t{kWidth} * kHeight * 4, 1);
    for (size_t node = 0; node < values.size(); ++node)
        std::fill_n(texels.begin() + static_cast<ptrdiff_t>(4 * nodeTexel(node)), 3, values[node]);
    void* slice = texels.data();
    astcenc_image image{kWidth, kHeight, 1, ASTCENC_TYPE_F32, &slice};

    AstcTable table;
    table.block = block;
    table.blocks.resize(blocksAlong(kWidth, block) * blocksAlong(kHeight, block) * kBlockBytes);
    auto* bytes = reinterpret_cast<uint8_t*>(table.blocks.data());
    const Context context = createContext(block);
    const astcenc_swizzle grey{ASTCENC_SWZ_R, ASTCENC_SWZ_R, ASTCENC_SWZ_R, ASTCENC_SWZ_1};
    const astcenc_error encoded =
        astcenc_compress_image(context.get(), &image, &grey, bytes, table.blocks.size(), 0);
    HEARTH_ASSERT(encoded == ASTCENC_SUCCESS);

    const astcenc_swizzle same{ASTCENC_SWZ_R, ASTCENC_SWZ_G, ASTCENC_SWZ_B, ASTCENC_SWZ_A};
    const astcenc_error decoded =
        astcenc_decompress_image(context.get(), bytes, table.blocks.size(), &image, &same, 0);
    HEARTH_ASSERT(decoded == ASTCENC_SUCCESS);
    for (size_t node = 0; node < values.size(); ++node)
        table.decoded[node] = texels[4 * nodeTexel(node)];
    return table;
}

std::vector<std::byte> astcFile(const AstcTable& table)
{
    const auto block = static_cast<uint8_t>(table.block);
    // magic, block, and three sizes of 24 bits, little-endian
    const std::array<uint8_t, 16> header{0x13,        0xAB, 0xA1,    0x5C, block, block, 1, kWidth & 0xFF,
                                         kWidth >> 8, 0,    kHeight, 0,    0,     1,     0, 0};
    std::vector<std::byte> file;
    for (const uint8_t byte : header)
        file.push_back(std::byte{byte});
    file.insert(file.end(), table.blocks.begin(), table.blocks.end());
    return file;
}

} // namespace hearth::specular
