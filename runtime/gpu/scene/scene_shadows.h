// The shadow maps of a scene: their image, a layer a map, and what is known of them from frame to frame.
// See runtime/gpu/README.md, "Shadows".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/scene/scene.h"
#include "runtime/gpu/scene/shadow_cache.h"

namespace hearth::gpu
{

/// Format of the maps.
inline constexpr VkFormat kShadowFormat = VK_FORMAT_D32_SFLOAT;

/// Of the last frame.
struct ShadowStatistics
{
    uint32_t maps = 0;              ///< in use
    uint32_t drawn_maps = 0;        ///< of these, drawn by the frame; the others were kept
    uint32_t moved_maps = 0;        ///< of these, in which the frame drew what moves
    uint32_t dropped_maps = 0;      ///< for which there was no layer
    uint32_t unshadowed_lights = 0; ///< suns and spots without a map: beyond the capacity
};

/// Belongs to a scene and one queue. What a frame records counts as drawn: it must be submitted.
class SceneShadows
{
public:
    /// render_pass  of a ShadowPass
    /// pack         that of the scene
    /// errors: device_limit, device_failed.
    static Result<std::unique_ptr<SceneShadows>> create(const Device& device, VkRenderPass render_pass,
                                                        const formats::PackView& pack, const Box3& bounds,
                                                        const ShadowOptions& options);

    /// What moves and streams in with a frame, whether it is drawn or only prefetched.
    void track(std::span<const InstanceMove> moves, std::span<const pack::ResidentGroups::Change> groups);

    /// A light is another from this frame on; nothing where it casts none.
    void change(uint32_t light, const shared::Light& record);

    /// A new pose, from this frame on.
    void pose(const DeformedInstance& instance, const PosedRows& rows) { cache_.pose(instance, rows); }

    /// Decide the maps of a frame; returns those that it must draw.
    ///
    /// spheres  beside those of the pack
    std::span<const ShadowCache::StaleMap> planFrame(const shared::FrameView& view,
                                                     std::span<const ShadowSphere> spheres);

    /// Of the last frame.
    const ShadowPlan& plan() const { return plan_; }
    const ShadowStatistics& statistics() const { return statistics_; }

    /// Let the next frame draw all its maps.
    void forget() { cache_.forget(); }

    const Buffer& block() const { return block_; } ///< shared::ShadowBlock
    /// shared::FrameCounters of each layer: the clusters that were drawn, and for which the visible list had no slot.
    const Buffer& casters() const { return casters_; }
    const Image& image() const { return image_; } ///< D32 in SHADER_READ_ONLY_OPTIMAL between frames
    VkSampler sampler() const { return sampler_.get(); }
    VkFramebuffer framebuffer(uint32_t layer) const { return layers_[layer].framebuffer.get(); }
    VkDeviceSize allocatedBytes() const { return arena_.allocatedBytes(); }

private:
    struct Layer
    {
        UniqueImageView view;
        UniqueFramebuffer framebuffer;
    };
    SceneShadows(const Device& device, const formats::PackView& pack, const ShadowOptions& options)
        : options_(options), cache_(pack, options), arena_(device, 0)
    {
    }
    Status createImage();
    uint32_t layerCount() const { return options_.moving_layers ? 2 * options_.max_maps : options_.max_maps; }
    Status createLayer(const Device& device, VkRenderPass render_pass, Layer& layer, uint32_t number) const;

    ShadowOptions options_;
    Box3 bounds_; ///< of the scene
    std::vector<CastingLight> lights_;
    size_t pack_sphere_count_ = 0;
    std::vector<ShadowSphere> spheres_; ///< of the pack, then of the frame
    uint32_t lights_without_row_ = 0;
    ShadowCache cache_;
    ShadowPlan plan_;
    ShadowStatistics statistics_;

    MemoryArena arena_;
    Image image_;
    UniqueSampler sampler_;
    Buffer block_;
    Buffer casters_;
    std::vector<Layer> layers_;
};

} // namespace hearth::gpu
