// Fuzzes the decoders of texels with libFuzzer. The input gives a format, the size of a mip, and its first
// blocks; the other blocks repeat them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/byte_reader.h"
#include "formats/texels/decode_texels.h"

#include <cstdint>
#include <iterator>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    using namespace hearth;
    using namespace hearth::formats;
    ByteReader reader(std::as_bytes(std::span(data, size)));
    const auto format = reader.read<uint8_t>(), width = reader.read<uint8_t>(),
               height = reader.read<uint8_t>();
    if (!height || reader.remaining() == 0)
        return 0;
    const TexelFormatTraits& traits = detail::kTexelFormats[*format % std::size(detail::kTexelFormats)];
    const uint32_t columns = 1 + *width % 30u, rows = 1 + *height % 30u;
    const auto content = std::as_bytes(std::span(data, size)).subspan(reader.position());
    std::vector<std::byte> mip(static_cast<size_t>(mipBytes(traits, columns, rows)));
    for (size_t i = 0; i < mip.size(); ++i)
        mip[i] = content[i % content.size()];
    static_cast<void>(decodeMip(traits, columns, rows, mip));
    return 0;
}
