// Reads the linear colours of a drawn frame.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/half.h"
#include "runtime/viewer/vulkan_host.h"

#include <array>
#include <cstring>
#include <vector>

namespace hearth::test
{

/// Return the linear colours of the last frame, which has been executed, row by row.
/// targets  with keeps_radiance, of a renderer with PostSupport::half
inline std::vector<Float3> readRadiance(viewer::VulkanHost& host, const gpu::Renderer& renderer,
                                        const gpu::FrameTargets& targets)
{
    constexpr uint32_t kPixelBytes = 8;
    const auto bytes = host.readSampled(renderer.device(), targets.post().radiance(), kPixelBytes);
    HEARTH_ASSERT(bytes.ok());
    std::vector<Float3> radiance;
    for (size_t i = 0; i < bytes->size(); i += kPixelBytes)
    {
        std::array<uint16_t, 4> halves;
        std::memcpy(&halves, bytes->data() + i, sizeof(halves));
        radiance.push_back({floatFromHalf(halves[0]), floatFromHalf(halves[1]), floatFromHalf(halves[2])});
    }
    return radiance;
}

} // namespace hearth::test
