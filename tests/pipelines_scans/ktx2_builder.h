// Builds KTX2 files byte by byte.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/images/decode.h"
#include "pipelines/import/part/part_builder.h"

#include <array>
#include <cstring>
#include <vector>

namespace hearth::import::test
{

using Bytes = std::vector<uint8_t>;
using Rgba8 = std::array<uint8_t, 4>;

inline void append(Bytes& bytes, uint64_t value, size_t size)
{
    for (size_t i = 0; i < size; ++i)
        bytes.push_back(i < sizeof(value) ? static_cast<uint8_t>(value >> (8 * i)) : uint8_t{0});
}

/// KTX2 file; by default 2 x 2 texels of RGBA8.
struct Ktx2
{
    uint32_t vk_format = 37; // R8G8B8A8_UNORM
    uint32_t width = 2;
    uint32_t height = 2;
    uint32_t depth = 0;
    uint32_t layers = 0;
    uint32_t faces = 1;
    uint32_t level_count = 1;
    uint32_t scheme = 0;
    uint8_t model = 1; // RGBSDA
    uint8_t transfer = 0;
    uint8_t flags = 0;
    std::vector<uint8_t> channels = {0, 1, 2, 15};
    Bytes key_values{};
    Bytes global_data{};
    std::vector<Bytes> levels = {Bytes(16)}; // finest first
    std::vector<uint64_t> uncompressed = {16};

    /// Add an entry of key and value; the value is a text that ends in 0.
    void addText(const std::string& key, const std::string& value)
    {
        append(key_values, key.size() + value.size() + 2, 4);
        for (const std::string& text : {key, value})
        {
            key_values.insert(key_values.end(), text.begin(), text.end());
            key_values.push_back(0);
        }
        key_values.resize((key_values.size() + 3) / 4 * 4);
    }

    Bytes file() const
    {
        Bytes descriptor;
        const auto block = static_cast<uint32_t>(24 + 16 * channels.size());
        append(descriptor, 4 + block, 4);
        append(descriptor, 0, 4);
        append(descriptor, 2 | block << 16, 4);
        append(descriptor, model | uint32_t{transfer} << 16 | uint32_t{flags} << 24, 4);
        append(descriptor, 0, 12);
        for (const uint8_t channel : channels)
        {
            append(descriptor, uint32_t{channel} << 24, 4);
            append(descriptor, 0, 12);
        }
        const size_t descriptor_at = 80 + 24 * levels.size();
        const size_t key_values_at = descriptor_at + descriptor.size();
        const size_t global_at = (key_values_at + key_values.size() + 7) / 8 * 8;
        size_t end = global_at + global_data.size();

        std::vector<size_t> offsets(levels.size());
        for (size_t i = levels.size(); i-- > 0;)
        {
            offsets[i] = (end + 47) / 48 * 48; // suits texels of 3, 4 and 16 bytes
            end = offsets[i] + levels[i].size();
        }
        Bytes bytes = {0xAB, 'K', 'T', 'X', ' ', '2', '0', 0xBB, '\r', '\n', 0x1A, '\n'};
        for (const uint32_t value : {vk_format, 1u, width, height, depth, layers, faces, level_count, scheme})
            append(bytes, value, 4);
        append(bytes, descriptor_at, 4);
        append(bytes, descriptor.size(), 4);
        append(bytes, key_values.empty() ? 0 : key_values_at, 4);
        append(bytes, key_values.size(), 4);
        append(bytes, global_data.empty() ? 0 : global_at, 8);
        append(bytes, global_data.size(), 8);
        for (size_t i = 0; i < levels.size(); ++i)
        {
            append(bytes, offsets[i], 8);
            append(bytes, levels[i].size(), 8);
            append(bytes, uncompressed[i], 8);
        }
        bytes.insert(bytes.end(), descriptor.begin(), descriptor.end());
        bytes.insert(bytes.end(), key_values.begin(), key_values.end());
        bytes.resize(global_at);
        bytes.insert(bytes.end(), global_data.begin(), global_data.end());
        for (size_t i = levels.size(); i-- > 0;)
        {
            bytes.resize(offsets[i]);
            bytes.insert(bytes.end(), levels[i].begin(), levels[i].end());
        }
        return bytes;
    }
};

inline Result<DecodedImage> decode(const Bytes& bytes)
{
    return decodeImage(std::as_bytes(std::span(bytes)), "texture", {});
}

inline Rgba8 getTexel(const DecodedImage& image, size_t x, size_t y)
{
    Rgba8 texel{};
    std::memcpy(texel.data(), &image.texels.at((y * image.width + x) * 4), 4);
    return texel;
}

} // namespace hearth::import::test
