// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/texture_files/data_format.h"

namespace hearth::texture_files
{

using namespace formats;

namespace
{

constexpr uint32_t kVersion = 2;
constexpr uint32_t kPrimariesBt709 = 1;
constexpr uint32_t kTransferLinear = 1, kTransferSrgb = 2;
constexpr uint32_t kModelRgb = 1;

// Channels of the models
constexpr uint32_t kAlpha = 15;
constexpr uint32_t kEtc2Colour = 2;
constexpr uint32_t kBc1AlphaPresent = 1;

// Qualifiers of a sample, beside its channel
constexpr uint32_t kLinear = 1 << 4, kExponent = 1 << 5, kSigned = 1 << 6, kFloat = 1 << 7;

constexpr uint32_t kFloatOne = 0x3F800000, kFloatMinusOne = 0xBF800000;

/// Range of bits of a block. Samples with one bit offset share their bits.
struct Sample
{
    uint32_t bit, bits;
    uint32_t channel; ///< with qualifiers
    uint32_t lower, upper;
};

struct Description
{
    uint32_t model;
    std::vector<Sample> samples;
};

/// Return a sample of a compressed format or of whole numbers: 0 to 1, or -1 to 1.
Sample makeSample(const TexelFormatTraits& traits, uint32_t bit, uint32_t bits, uint32_t channel)
{
    const bool is_alpha = channel == kAlpha;
    const uint32_t unit = bits >= 32 ? 0xFFFFFFFFu : (1u << bits) - 1;
    switch (traits.coding)
    {
    case TexelCoding::unorm:
        return {bit, bits, channel, 0, unit};
    case TexelCoding::snorm: // those of the table are compressed
        return {bit, bits, channel | kSigned, 0x80000000u, 0x7FFFFFFFu};
    case TexelCoding::srgb:
        return {bit, bits, is_alpha ? channel | kLinear : channel, 0, unit};
    case TexelCoding::float_value:
        break;
    }
    if (traits.format == TexelFormat::bc6h_ufloat)
        return {bit, bits, channel | kFloat, 0, kFloatOne};
    return {bit, bits, channel | kFloat | kSigned, kFloatMinusOne, kFloatOne};
}

Description describePlain(const TexelFormatTraits& traits)
{
    Description out{kModelRgb, {}};
    if (traits.format == TexelFormat::rgb9e5_float)
    {
        // 1 is a mantissa of 256 with an exponent of 16; both together are 0x2100
        for (uint32_t c = 0; c < 3; ++c)
        {
            out.samples.push_back({9 * c, 9, c, 0, 0x2100});
            out.samples.push_back({27, 5, c | kExponent, 15, 31});
        }
        return out;
    }
    const uint32_t bits = 8u * traits.block_bytes / traits.channels;
    for (uint32_t c = 0; c < traits.channels; ++c)
        out.samples.push_back(makeSample(traits, c * bits, bits, c == 3 ? kAlpha : c));
    return out;
}

Description describeEtc2(const TexelFormatTraits& traits)
{
    constexpr uint32_t kModel = 161;
    switch (traits.format)
    {
    case TexelFormat::eac_r11_unorm:
    case TexelFormat::eac_r11_snorm:
        return {kModel, {makeSample(traits, 0, 64, 0)}};
    case TexelFormat::eac_rg11_unorm:
    case TexelFormat::eac_rg11_snorm:
        return {kModel, {makeSample(traits, 0, 64, 0), makeSample(traits, 64, 64, 1)}};
    case TexelFormat::etc2_rgba8_unorm:
    case TexelFormat::etc2_rgba8_srgb:
        return {kModel, {makeSample(traits, 0, 64, kAlpha), makeSample(traits, 64, 64, kEtc2Colour)}};
    case TexelFormat::etc2_rgb8a1_unorm:
    case TexelFormat::etc2_rgb8a1_srgb:
        return {kModel, {makeSample(traits, 0, 64, kEtc2Colour), makeSample(traits, 0, 64, kAlpha)}};
    default:
        return {kModel, {makeSample(traits, 0, 64, kEtc2Colour)}};
    }
}

Description describeBc(const TexelFormatTraits& traits)
{
    constexpr uint32_t kModelBc1 = 128, kModelBc2 = 129, kModelBc3 = 130, kModelBc4 = 131, kModelBc5 = 132,
                       kModelBc6h = 133, kModelBc7 = 134;
    const auto colour_behind_alpha = [&](uint32_t model) -> Description {
        return {model, {makeSample(traits, 0, 64, kAlpha), makeSample(traits, 64, 64, 0)}};
    };
    switch (traits.format)
    {
    case TexelFormat::bc1_rgb_unorm:
    case TexelFormat::bc1_rgb_srgb:
        return {kModelBc1, {makeSample(traits, 0, 64, 0)}};
    case TexelFormat::bc1_rgba_unorm:
    case TexelFormat::bc1_rgba_srgb:
        return {kModelBc1, {makeSample(traits, 0, 64, kBc1AlphaPresent)}};
    case TexelFormat::bc2_unorm:
    case TexelFormat::bc2_srgb:
        return colour_behind_alpha(kModelBc2);
    case TexelFormat::bc3_unorm:
    case TexelFormat::bc3_srgb:
        return colour_behind_alpha(kModelBc3);
    case TexelFormat::bc4_unorm:
    case TexelFormat::bc4_snorm:
        return {kModelBc4, {makeSample(traits, 0, 64, 0)}};
    case TexelFormat::bc5_unorm:
    case TexelFormat::bc5_snorm:
        return {kModelBc5, {makeSample(traits, 0, 64, 0), makeSample(traits, 64, 64, 1)}};
    case TexelFormat::bc6h_ufloat:
    case TexelFormat::bc6h_sfloat:
        return {kModelBc6h, {makeSample(traits, 0, 128, 0)}};
    default:
        return {kModelBc7, {makeSample(traits, 0, 128, 0)}};
    }
}

Description describe(const TexelFormatTraits& traits)
{
    constexpr uint32_t kModelAstc = 162;
    switch (traits.family)
    {
    case TexelFamily::plain:
        return describePlain(traits);
    case TexelFamily::astc:
    case TexelFamily::astc_hdr:
        return {kModelAstc, {makeSample(traits, 0, 128, 0)}};
    case TexelFamily::etc2:
        return describeEtc2(traits);
    case TexelFamily::bc:
        break;
    }
    return describeBc(traits);
}

} // namespace

std::vector<uint32_t> describeTexels(const TexelFormatTraits& traits)
{
    const Description description = describe(traits);
    const uint32_t transfer = traits.coding == TexelCoding::srgb ? kTransferSrgb : kTransferLinear;
    const auto block_bytes = static_cast<uint32_t>(24 + 16 * description.samples.size());
    std::vector<uint32_t> words = {
        4 + block_bytes,
        0, // vendor Khronos, type basic
        kVersion | block_bytes << 16,
        description.model | kPrimariesBt709 << 8 | transfer << 16,
        (traits.block_width - 1u) | (traits.block_height - 1u) << 8,
        traits.block_bytes, // of plane 0
        0,
    };
    for (const Sample& sample : description.samples)
        words.insert(words.end(), {sample.bit | (sample.bits - 1) << 16 | sample.channel << 24, 0,
                                   sample.lower, sample.upper});
    return words;
}

uint32_t typeBytes(const TexelFormatTraits& traits)
{
    if (traits.family != TexelFamily::plain)
        return 1;
    return traits.format == TexelFormat::rgb9e5_float ? 4u : traits.block_bytes / traits.channels;
}

} // namespace hearth::texture_files
