// Shadow maps of a scene: their array image with one layer per map, and the cache of valid maps from frame to
// frame. See runtime/gpu/README.md, "Shadows".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/frame/shadow_lights.h"
#include "runtime/gpu/scene/scene.h"
#include "runtime/gpu/scene/shadow_cache.h"

namespace hearth::gpu
{

/// Return the format of the maps. Vulkan requires both to be drawn to and sampled.
constexpr VkFormat shadowFormat(ShadowDepth depth)
{
    return depth == ShadowDepth::d16 ? VK_FORMAT_D16_UNORM : VK_FORMAT_D32_SFLOAT;
}

/// Shadow statistics of the last frame.
struct ShadowStatistics
{
    uint32_t maps = 0;              ///< in use
    uint32_t drawn_maps = 0;        ///< drawn by the frame; the others were cached
    uint32_t moved_maps = 0;        ///< maps in which the frame drew moving casters
    uint32_t unseen_maps = 0;       ///< of faces that no point in view is in: not needed, and not in use
    uint32_t dropped_maps = 0;      ///< maps for which there was no layer
    uint32_t shadowed_lights = 0;   ///< lights with maps
    uint32_t unshadowed_lights = 0; ///< lights that are on, without a map: beyond the capacity
};

/// Shadow maps of one scene on one queue. A recorded frame counts as drawn: it must be submitted.
class SceneShadows
{
public:
    /// Choose the depths of a scene's maps.
    static ShadowDepthChoice chooseDepth(const formats::PackView& pack, const Box3& bounds,
                                         const ShadowOptions& options);

    /// render_pass  of a ShadowPass of these depths
    /// pack         of the scene
    /// max_lights   slots of lights
    /// motions      of the scene; outlive the shadows
    /// errors: device_limit, device_failed.
    static Result<std::unique_ptr<SceneShadows>> create(const Device& device, VkRenderPass render_pass,
                                                        const formats::PackView& pack, const Box3& bounds,
                                                        const VertexMotions& motions, uint32_t max_lights,
                                                        const ShadowOptions& options,
                                                        const ShadowDepthChoice& depth);

    /// Pass the moves and the streamed groups of a frame, drawn or only prefetched, to the cache.
    void track(std::span<const InstanceMove> moves, std::span<const pack::ResidentGroups::Change> groups);

    /// Pass the inputs of materials to the cache, by which vertices move.
    void trackInputs(const Float4& inputs);

    /// Set the luminance of a light's intensity without flicker, by which lights are ranked, from this frame
    /// on.
    void change(uint32_t slot, float luminance);

    /// Choose the lights that have maps in a frame, and write their rows to the table of lights.
    void chooseLights(const shared::FrameView& view, SceneLights& lights, MirroredTable& table);

    /// Set a new pose from this frame on.
    void pose(const DeformedInstance& instance, const PoseRows& rows) { cache_.pose(instance, rows); }

    /// Make room for the spheres of a frame, before it is recorded: planFrame then allocates nothing.
    void reserveSpheres(size_t count) { spheres_.reserve(pack_sphere_count_ + count); }

    /// Plan the maps of the lights chosen last; returns the maps that the frame must draw.
    ///
    /// lights   all slots
    /// spheres  beside the spheres of the pack
    std::span<const ShadowCache::LayerUpdate> planFrame(const shared::FrameView& view,
                                                        std::span<const shared::Light> lights,
                                                        std::span<const ShadowSphere> spheres);

    /// Return the maps that planFrame would return for a frame with these moves; changes nothing.
    std::vector<ShadowCache::LayerUpdate> findStale(const shared::FrameView& view,
                                                    std::span<const shared::Light> lights,
                                                    std::span<const ShadowSphere> spheres,
                                                    std::span<const InstanceMove> moves) const;

    /// Lights chosen last.
    std::span<const shared::ShadowLights::Holder> holders() const { return chosen_.holders(); }

    /// Plan of the last frame.
    const ShadowPlan& plan() const { return plan_; }
    const ShadowStatistics& statistics() const { return statistics_; }

    /// Invalidate the cache: the next frame draws all its maps.
    void forget() { cache_.forget(); }

    /// shared::FrameCounters per layer: the clusters drawn, and the clusters dropped for lack of slots in the
    /// visible list.
    const Buffer& casters() const { return casters_; }
    /// A word per layer: the triangles of proxies drawn; not written unless proxies cast shadows.
    const Buffer& proxyTriangles() const { return proxy_triangles_; }
    const Image& image() const { return image_; } ///< in SHADER_READ_ONLY_OPTIMAL between frames
    const ShadowDepthChoice& depth() const { return depth_; }
    VkSampler sampler() const { return sampler_.get(); }
    bool filters() const { return filters_; } ///< compares may be bilinear
    VkFramebuffer framebuffer(uint32_t layer) const { return layers_[layer].framebuffer.get(); }
    VkDeviceSize allocatedBytes() const { return arena_.allocatedBytes(); }

private:
    struct Layer
    {
        UniqueImageView view;
        UniqueFramebuffer framebuffer;
    };
    SceneShadows(const Device& device, const formats::PackView& pack, const VertexMotions& motions,
                 uint32_t max_lights, const ShadowOptions& options, const ShadowDepthChoice& depth)
        : options_(options),
          depth_(depth),
          filters_(depth.depth == ShadowDepth::d16 ? device.filters_d16 : device.filters_d32),
          chosen_(max_lights),
          motions_(motions),
          cache_(pack, options, motions.reaches),
          arena_(device, 0)
    {
        options_.depth = depth.depth;
        luminances_.reserve(max_lights);
        projections_.reserve(shared::kMaxShadowProjections);
    }
    Status createImage();
    void choose(const shared::FrameView& view, std::span<const shared::Light> lights,
                shared::ShadowLights& chosen) const;
    void makeCasters(const shared::FrameView& view, const shared::ShadowLights& chosen,
                     std::span<const shared::Light> lights, std::vector<ShadowCaster>& casters) const;
    uint32_t layerCount() const { return options_.moving_layers ? 2 * options_.max_maps : options_.max_maps; }
    Status createLayer(const Device& device, VkRenderPass render_pass, Layer& layer, uint32_t number) const;

    ShadowOptions options_; ///< with the depth that was chosen
    ShadowDepthChoice depth_;
    bool filters_;
    Box3 bounds_;                   ///< of the scene
    std::vector<float> luminances_; ///< of slots, without flicker; 0: off
    shared::ShadowLights chosen_;
    std::vector<ShadowCaster> projections_; ///< of the chosen lights, in the last frame
    size_t pack_sphere_count_ = 0;
    std::vector<ShadowSphere> spheres_; ///< of the pack, then of the frame
    const VertexMotions& motions_;
    std::optional<Float4> inputs_; ///< of materials, in the last frame
    ShadowCache cache_;
    ShadowPlan plan_;
    ShadowStatistics statistics_;

    MemoryArena arena_;
    Image image_;
    UniqueSampler sampler_;
    Buffer casters_;
    Buffer proxy_triangles_;
    std::vector<Layer> layers_;
};

} // namespace hearth::gpu
