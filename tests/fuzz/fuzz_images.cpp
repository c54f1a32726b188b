// Fuzzes the readers of images with libFuzzer: KTX2 and DDS by the first byte, and others by what follows.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/images/decode.h"

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    using namespace hearth::import;
    using namespace std::string_view_literals;
    // a small limit: large images only take time
    constexpr ImportLimits kLimits{.max_image_texels = 1 << 14, .max_image_size = 1 << 10};
    constexpr std::array kSignatures = {"\xABKTX 20\xBB\r\n\x1A\n"sv, "DDS "sv, ""sv};
    if (size == 0)
        return 0;
    const std::string_view signature = kSignatures[data[0] % kSignatures.size()];
    std::vector<std::byte> bytes;
    for (const char letter : signature)
        bytes.push_back(static_cast<std::byte>(letter));
    const auto rest = std::as_bytes(std::span(data, size)).subspan(1);
    bytes.insert(bytes.end(), rest.begin(), rest.end());
    static_cast<void>(decodeImage(bytes, "image", kLimits));
    return 0;
}
