// State of a scene that a frame changes, once for each frame in flight, and for each view of the frame that
// is culled and drawn: its own image and stale shadow maps.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/records.h"
#include "formats/gpu_shared/shadows/proxy_casters.h"
#include "runtime/gpu/vulkan/pipelines.h"

#include <array>
#include <vector>

namespace hearth::gpu
{

/// Largest SceneOptions::frames_in_flight.
inline constexpr uint32_t kMaxFramesInFlight = 4;

/// One descriptor set per pipeline of the culling pass.
struct CullSets
{
    VkDescriptorSet instances, clusters, scan_blocks, scan_totals, emit_visible, emit_draws;
    VkDescriptorSet deformed_clusters; ///< scenes with deformed meshes only
    VkDescriptorSet list_proxies;      ///< shadow maps of scenes whose proxies cast only
};

/// One view of a frame: the buffers that its culling fills and its draws read.
struct SceneView
{
    Buffer frame; ///< shared::FrameView; mapped
    Buffer counters, visible, bin_draws;
    Buffer material_draws; ///< mapped; zero before culling
    Buffer proxy_draw;     ///< shared::ProxyDraw, reset before culling; mapped
    Buffer proxy_chunks;   ///< of shadow maps in scenes whose proxies cast only, as proxy_draw
    VkDescriptorSet draw_set = VK_NULL_HANDLE;
    VkDescriptorSet bins_set = VK_NULL_HANDLE;
    VkDescriptorSet proxy_set = VK_NULL_HANDLE;
    CullSets cull_sets{};
};

/// Return the draw of a view before proxies are listed.
inline shared::ProxyDraw emptyProxyDraw()
{
    return {shared::kProxyChunkVertices, 0, 0, 0, 0};
}

/// Everything that a frame may change while the one before is still drawn.
struct SceneFrame
{
    SceneView main;
    std::vector<SceneView> casters; ///< shadow maps that are culled side by side; scenes with shadows only
    Buffer tile_draws;              ///< mapped; zero before the tiles are listed
    Buffer page_requests;           ///< mapped, a word per page; streamed scenes only
    Buffer copy_regions;            ///< mapped: shared::CopyRegion of the frame's copies, see word_copies.h
    /// Copies into the slices of the geometry pool, and into the groups; streamed scenes only.
    std::array<VkDescriptorSet, shared::kPoolSlices + 1> stream_copy_sets{};
    VkDescriptorSet brick_copy_set = VK_NULL_HANDLE; ///< of fresh light; scenes with bricks only
    VkDescriptorSet cluster_view_set = VK_NULL_HANDLE;
    VkDescriptorSet light_set = VK_NULL_HANDLE;                 ///< passes that list or count lights
    VkDescriptorSet slot_light_set = VK_NULL_HANDLE;            ///< once LightMethod::forward is prepared
    VkDescriptorSet tile_set = VK_NULL_HANDLE;                  ///< material-tiles pass
    VkDescriptorSet page_request_set = VK_NULL_HANDLE;          ///< streamed scenes only
    VkDescriptorSet deformed_page_request_set = VK_NULL_HANDLE; ///< streamed scenes with deformed meshes
    VkDescriptorSet skinning_set = VK_NULL_HANDLE;              ///< scenes with deformed meshes only
    VkDescriptorSet brick_set = VK_NULL_HANDLE;                 ///< scenes with bricks only; as the next ones
    Buffer brick_view;                                          ///< shared::BrickView; mapped
    Buffer shadow_block; ///< shared::ShadowBlock; mapped; scenes with shadows only
};

} // namespace hearth::gpu
