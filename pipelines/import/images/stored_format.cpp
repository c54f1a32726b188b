// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/images/stored_format.h"

#include <algorithm>
#include <iterator>

namespace hearth::import
{

namespace
{

struct PlainFormat
{
    uint32_t vulkan_format;
    PlainLayout layout;
};

constexpr auto kUnorm = ChannelCoding::unorm;
constexpr auto kSnorm = ChannelCoding::snorm;
constexpr auto kFloat = ChannelCoding::float_value;

/// Return the layout of channels of the same size, one behind the other.
constexpr PlainLayout inOrder(ChannelCoding coding, uint8_t bits, uint8_t count)
{
    PlainLayout layout{coding, static_cast<uint8_t>(bits * count / 8), {}};
    for (uint8_t c = 0; c < count; ++c)
        layout.channels[c] = {static_cast<uint8_t>(c * bits), bits};
    return layout;
}

constexpr PlainLayout blueFirst(ChannelCoding coding, uint8_t count)
{
    PlainLayout layout = inOrder(coding, 8, count);
    std::swap(layout.channels[0], layout.channels[2]);
    return layout;
}

constexpr PlainLayout inWord(uint8_t bytes, ChannelBits red, ChannelBits green, ChannelBits blue,
                             ChannelBits alpha)
{
    return {kUnorm, bytes, {red, green, blue, alpha}};
}

// clang-format off
constexpr PlainFormat kPlainFormats[] = {
    {2, inWord(2, {12, 4}, {8, 4}, {4, 4}, {0, 4})},           // R4G4B4A4_UNORM_PACK16
    {3, inWord(2, {4, 4}, {8, 4}, {12, 4}, {0, 4})},           // B4G4R4A4
    {4, inWord(2, {11, 5}, {5, 6}, {0, 5}, {})},               // R5G6B5
    {5, inWord(2, {0, 5}, {5, 6}, {11, 5}, {})},               // B5G6R5
    {6, inWord(2, {11, 5}, {6, 5}, {1, 5}, {0, 1})},           // R5G5B5A1
    {7, inWord(2, {1, 5}, {6, 5}, {11, 5}, {0, 1})},           // B5G5R5A1
    {8, inWord(2, {10, 5}, {5, 5}, {0, 5}, {15, 1})},          // A1R5G5B5
    {9, inOrder(kUnorm, 8, 1)},                                // R8_UNORM, SNORM, SRGB
    {10, inOrder(kSnorm, 8, 1)},
    {15, inOrder(kUnorm, 8, 1)},
    {16, inOrder(kUnorm, 8, 2)},                               // R8G8
    {17, inOrder(kSnorm, 8, 2)},
    {22, inOrder(kUnorm, 8, 2)},
    {23, inOrder(kUnorm, 8, 3)},                               // R8G8B8
    {24, inOrder(kSnorm, 8, 3)},
    {29, inOrder(kUnorm, 8, 3)},
    {30, blueFirst(kUnorm, 3)},                                // B8G8R8
    {36, blueFirst(kUnorm, 3)},
    {37, inOrder(kUnorm, 8, 4)},                               // R8G8B8A8
    {38, inOrder(kSnorm, 8, 4)},
    {43, inOrder(kUnorm, 8, 4)},
    {44, blueFirst(kUnorm, 4)},                                // B8G8R8A8
    {50, blueFirst(kUnorm, 4)},
    {58, inWord(4, {20, 10}, {10, 10}, {0, 10}, {30, 2})},     // A2R10G10B10_UNORM_PACK32
    {64, inWord(4, {0, 10}, {10, 10}, {20, 10}, {30, 2})},     // A2B10G10R10
    {70, inOrder(kUnorm, 16, 1)},                              // R16_UNORM, SNORM, SFLOAT
    {71, inOrder(kSnorm, 16, 1)},
    {76, inOrder(kFloat, 16, 1)},
    {77, inOrder(kUnorm, 16, 2)},                              // R16G16
    {78, inOrder(kSnorm, 16, 2)},
    {83, inOrder(kFloat, 16, 2)},
    {84, inOrder(kUnorm, 16, 3)},                              // R16G16B16
    {85, inOrder(kSnorm, 16, 3)},
    {90, inOrder(kFloat, 16, 3)},
    {91, inOrder(kUnorm, 16, 4)},                              // R16G16B16A16
    {92, inOrder(kSnorm, 16, 4)},
    {97, inOrder(kFloat, 16, 4)},
    {100, inOrder(kFloat, 32, 1)},                             // R32_SFLOAT and so on
    {103, inOrder(kFloat, 32, 2)},
    {106, inOrder(kFloat, 32, 3)},
    {109, inOrder(kFloat, 32, 4)},
    {122, {kFloat, 4, {{{0, 11}, {11, 11}, {22, 10}, {}}}}},   // B10G11R11_UFLOAT_PACK32
    {1000340000, inWord(2, {8, 4}, {4, 4}, {0, 4}, {12, 4})},  // A4R4G4B4_UNORM_PACK16
    {1000340001, inWord(2, {0, 4}, {4, 4}, {8, 4}, {12, 4})},  // A4B4G4R4
    {1000470000, inWord(2, {0, 5}, {5, 5}, {10, 5}, {15, 1})}, // A1B5G5R5
    {1000470001, inWord(1, {}, {}, {}, {0, 8})},               // A8_UNORM
};
// clang-format on

} // namespace

uint64_t StoredFormat::levelBytes(uint32_t width, uint32_t height) const
{
    return traits != nullptr ? formats::mipBytes(*traits, width, height)
                             : uint64_t{width} * height * plain.texel_bytes;
}

std::optional<StoredFormat> findStoredFormat(uint32_t vulkan_format)
{
    const auto* const plain =
        std::find_if(std::begin(kPlainFormats), std::end(kPlainFormats),
                     [&](const PlainFormat& format) { return format.vulkan_format == vulkan_format; });
    if (plain != std::end(kPlainFormats))
        return StoredFormat{nullptr, plain->layout};
    for (const formats::TexelFormatTraits& traits : formats::detail::kTexelFormats)
        if (traits.vulkan_format == vulkan_format && vulkan_format != 0)
            return StoredFormat{&traits, {}};
    return std::nullopt;
}

} // namespace hearth::import
