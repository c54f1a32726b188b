// Builds DDS files byte by byte.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/pipelines_scans/ktx2_builder.h"

#include <optional>
#include <string_view>

namespace hearth::import::test
{

/// Header that Direct3D 10 added.
struct Dx10
{
    uint32_t format = 28; // R8G8B8A8_UNORM
    uint32_t dimension = 3;
    uint32_t flags = 0;
    uint32_t layers = 1;
    uint32_t alpha_mode = 0;
};

/// DDS file; by default 2 x 2 texels of A8R8G8B8.
struct Dds
{
    uint32_t width = 2;
    uint32_t height = 2;
    uint32_t format_flags = 0x41;
    uint32_t code = 0;
    uint32_t bits = 32;
    std::array<uint32_t, 4> masks = {0xFF0000, 0xFF00, 0xFF, 0xFF000000};
    uint32_t caps2 = 0;
    std::optional<Dx10> dx10{};
    Bytes texels = Bytes(16);

    static Dds withCode(std::string_view name, Bytes texels)
    {
        Dds dds;
        dds.format_flags = 4;
        dds.masks = {};
        for (size_t i = 0; i < 4; ++i)
            dds.code |= static_cast<uint32_t>(static_cast<uint8_t>(name[i])) << (8 * i);
        dds.texels = std::move(texels);
        return dds;
    }

    static Dds withDxgi(uint32_t format, Bytes texels)
    {
        Dds dds = withCode("DX10", std::move(texels));
        dds.dx10 = Dx10{.format = format};
        return dds;
    }

    Bytes file() const
    {
        Bytes bytes = {'D', 'D', 'S', ' '};
        for (const uint32_t value : {124u, 0x1007u, height, width, 0u, 0u, 1u})
            append(bytes, value, 4);
        append(bytes, 0, 44);
        for (const uint32_t value : {32u, format_flags, code, bits, masks[0], masks[1], masks[2], masks[3]})
            append(bytes, value, 4);
        for (const uint32_t value : {0x1000u, caps2, 0u, 0u, 0u})
            append(bytes, value, 4);
        if (dx10)
            for (const uint32_t value :
                 {dx10->format, dx10->dimension, dx10->flags, dx10->layers, dx10->alpha_mode})
                append(bytes, value, 4);
        bytes.insert(bytes.end(), texels.begin(), texels.end());
        return bytes;
    }
};

} // namespace hearth::import::test
