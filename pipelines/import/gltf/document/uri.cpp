// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf/document/uri.h"

#include <array>

namespace hearth::import
{

namespace
{

constexpr uint8_t kNotBase64 = 0xFF;

constexpr std::array<uint8_t, 256> base64Values()
{
    constexpr std::string_view kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::array<uint8_t, 256> values{};
    values.fill(kNotBase64);
    for (size_t i = 0; i < kAlphabet.size(); ++i)
        values[static_cast<unsigned char>(kAlphabet[i])] = static_cast<uint8_t>(i);
    return values;
}

std::optional<std::vector<std::byte>> decodeBase64(std::string_view text)
{
    static constexpr std::array<uint8_t, 256> kValues = base64Values();
    if (text.size() % 4 != 0)
        return std::nullopt;
    const size_t padding = text.ends_with("==") ? 2 : text.ends_with('=') ? 1 : 0;
    const size_t digits = text.size() - padding;

    std::vector<std::byte> bytes;
    bytes.reserve(text.size() / 4 * 3);
    uint32_t bits = 0;
    uint32_t bit_count = 0;
    for (size_t i = 0; i < digits; ++i)
    {
        const uint8_t value = kValues[static_cast<unsigned char>(text[i])];
        if (value == kNotBase64)
            return std::nullopt;
        bits = (bits << 6 | value) & 0xFFFFu;
        bit_count += 6;
        if (bit_count >= 8)
        {
            bit_count -= 8;
            bytes.push_back(static_cast<std::byte>(bits >> bit_count & 0xFFu));
        }
    }
    return bytes;
}

std::optional<unsigned> hexDigit(char c)
{
    if (c >= '0' && c <= '9')
        return static_cast<unsigned>(c - '0');
    if (c >= 'a' && c <= 'f')
        return static_cast<unsigned>(c - 'a' + 10);
    if (c >= 'A' && c <= 'F')
        return static_cast<unsigned>(c - 'A' + 10);
    return std::nullopt;
}

} // namespace

bool isDataUri(std::string_view uri)
{
    return uri.size() >= 5 && (uri[0] | 0x20) == 'd' && (uri[1] | 0x20) == 'a' && (uri[2] | 0x20) == 't' &&
           (uri[3] | 0x20) == 'a' && uri[4] == ':';
}

std::optional<std::vector<std::byte>> decodeDataUri(std::string_view uri)
{
    constexpr std::string_view kEncoding = ";base64";
    const size_t comma = uri.find(',');
    if (!isDataUri(uri) || comma == std::string_view::npos || !uri.substr(0, comma).ends_with(kEncoding))
        return std::nullopt;
    return decodeBase64(uri.substr(comma + 1));
}

std::optional<std::string> decodePercent(std::string_view uri)
{
    std::string text;
    text.reserve(uri.size());
    for (size_t i = 0; i < uri.size(); ++i)
    {
        if (uri[i] != '%')
        {
            text += uri[i];
            continue;
        }
        if (uri.size() - i < 3)
            return std::nullopt;
        const auto high = hexDigit(uri[i + 1]);
        const auto low = hexDigit(uri[i + 2]);
        if (!high || !low)
            return std::nullopt;
        text += static_cast<char>(*high << 4 | *low);
        i += 2;
    }
    return text;
}

} // namespace hearth::import
