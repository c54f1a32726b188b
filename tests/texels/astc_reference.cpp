// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/texels/astc_reference.h"

#include <astcenc.h>
#include <gtest/gtest.h>

namespace hearth::texels::test
{

std::vector<float> decodeByAstcenc(const formats::TexelFormatTraits& traits, uint32_t width, uint32_t height,
                                   std::span<const std::byte> mip)
{
    const astcenc_profile profile = traits.coding == formats::TexelCoding::srgb ? ASTCENC_PRF_LDR_SRGB
                                    : traits.coding == formats::TexelCoding::float_value ? ASTCENC_PRF_HDR
                                                                                         : ASTCENC_PRF_LDR;
    astcenc_config config{};
    EXPECT_EQ(astcenc_config_init(profile, traits.block_width, traits.block_height, 1, ASTCENC_PRE_FASTEST,
                                  ASTCENC_FLG_DECOMPRESS_ONLY, &config),
              ASTCENC_SUCCESS);
    astcenc_context* context = nullptr;
    EXPECT_EQ(astcenc_context_alloc(&config, 1, &context), ASTCENC_SUCCESS);
    std::vector<float> texels(size_t{width} * height * 4);
    void* slice = texels.data();
    astcenc_image image{width, height, 1, ASTCENC_TYPE_F32, &slice};
    constexpr astcenc_swizzle kSame{ASTCENC_SWZ_R, ASTCENC_SWZ_G, ASTCENC_SWZ_B, ASTCENC_SWZ_A};
    EXPECT_EQ(astcenc_decompress_image(context, reinterpret_cast<const uint8_t*>(mip.data()), mip.size(),
                                       &image, &kSame, 0),
              ASTCENC_SUCCESS);
    astcenc_context_free(context);
    return texels;
}

} // namespace hearth::texels::test
