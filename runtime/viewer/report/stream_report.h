// Streaming statistics of a frame.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/textures/streamed_textures.h"
#include "runtime/viewer/vulkan_host.h"

#include <optional>
#include <span>

namespace hearth::viewer
{

struct StreamCounts
{
    pack::StreamStatistics statistics;
    uint64_t frame = 0;         ///< serial of the frame: frames that only prefetched count
    uint32_t pages_wanted = 0;  ///< by this frame
    uint32_t pages_missing = 0; ///< of these, pages that were not resident: 0 in a frame that has converged
    std::optional<gpu::TextureStatistics> textures{}; ///< if textures are streamed
    uint32_t mips_missing = 0;                        ///< as pages_missing
};

/// Count for the last frame of a streamed scene, which has completed. errors: device_failed.
Result<StreamCounts> countStreaming(VulkanHost& host, const gpu::Renderer& renderer, const gpu::Scene& scene,
                                    uint64_t serial);

/// Format the last frame as a JSON object; several frames add an array with one object each as its member
/// "frames".
std::string formatStreaming(std::span<const StreamCounts> frames);

} // namespace hearth::viewer
