// What streaming did for a frame.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/viewer/vulkan_host.h"

#include <span>

namespace hearth::viewer
{

struct StreamCounts
{
    pack::StreamStatistics statistics;
    uint64_t frame = 0;         ///< its serial: frames that only asked for pages count
    uint32_t pages_wanted = 0;  ///< by this frame
    uint32_t pages_missing = 0; ///< of these, those that were not resident: 0 in a frame that has converged
};

/// Of the last frame of a streamed scene, which has completed. errors: device_failed.
Result<StreamCounts> countStreaming(VulkanHost& host, const gpu::Renderer& renderer, const gpu::Scene& scene,
                                    uint64_t serial);

/// A JSON object for the last frame, and where there are several, with an array of one for each as its member "frames".
std::string formatStreaming(std::span<const StreamCounts> frames);

} // namespace hearth::viewer
