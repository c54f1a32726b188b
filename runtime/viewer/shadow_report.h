// What shadows took in a frame.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/scene/scene_shadows.h"
#include "runtime/viewer/vulkan_host.h"

#include <span>

namespace hearth::viewer
{

struct ShadowCounts
{
    gpu::ShadowStatistics maps;
    uint64_t caster_clusters = 0;  ///< in the maps in use, when they were drawn
    uint64_t dropped_clusters = 0; ///< of these, for which the visible list had no slot
    uint64_t map_bytes = 0;
};

/// Of the last frame of a scene with shadows, which has completed. errors: device_failed.
Result<ShadowCounts> countShadows(VulkanHost& host, const gpu::Renderer& renderer, const gpu::Scene& scene);

/// A JSON object for the last frame, and where there are several, with an array of one for each as its member "frames".
std::string formatShadows(std::span<const ShadowCounts> frames);

} // namespace hearth::viewer
