// Shadow statistics of a frame.
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
    uint64_t caster_clusters = 0;  ///< clusters of the maps in use, counted when each map was drawn
    uint64_t dropped_clusters = 0; ///< of these, clusters without a slot in the visible list
    uint64_t proxy_triangles = 0;  ///< of the maps in use, as caster_clusters
    uint64_t map_bytes = 0;
    gpu::ShadowDepthChoice depth{};
};

/// Count for the last frame of a scene with shadows, which has completed. errors: device_failed.
Result<ShadowCounts> countShadows(VulkanHost& host, const gpu::Renderer& renderer, const gpu::Scene& scene);

/// Format the last frame as a JSON object; several frames add an array with one object each as its member
/// "frames".
std::string formatShadows(std::span<const ShadowCounts> frames);

} // namespace hearth::viewer
