// Shades the frame: the sky, then each visible material in its own pixels, which the depth test or the
// stencil finds. Follows the material marks.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/ambient_occlusion.h"
#include "formats/gpu_shared/shading.h"
#include "runtime/gpu/passes/frame_targets.h"
#include "runtime/gpu/post/post_settings.h"
#include "runtime/gpu/scene/scene.h"

#include <map>

namespace hearth::gpu
{

/// Area in which each material is shaded. The result is the same.
enum class ShadedArea : uint8_t
{
    automatic,  ///< its tiles, in scenes of more than kWholeFrameMaterials materials
    wholeFrame, ///< the whole frame: pixels of other materials fail the depth test
    tiles,      ///< its tiles
};

/// Largest number of materials that a scene shades in one render pass. See runtime/gpu/README.md, "Material
/// tiles".
inline constexpr uint32_t kWholeFrameMaterials = 8;

/// Shading settings of a frame.
struct ShadingSettings
{
    uint32_t debug_view = shared::kViewFinal; ///< one of shared::kView*
    float depth_scale = 1;                    ///< metres that the depth view shows as middle grey
    ShadedArea area = ShadedArea::automatic;
    uint32_t ambient_occlusion = shared::kAmbientOcclusionExact; ///< for meshes with visibility
    uint32_t specular_occlusion = shared::kSpecularOcclusionFit; ///< for meshes with visibility
    /// Indirect light for scenes with bricks (GI); false: constant sky.
    bool gi = true;
    LightMethod light_method = LightMethod::practical; ///< prepared: Renderer::prepareLightMethod
    LightLister light_lister = LightLister::gpu;
    PostSettings post{}; ///< of the final view
};

/// True if the frame draws levels of bloom.
inline bool usesBloom(const ShadingSettings& view)
{
    return view.debug_view == shared::kViewFinal && view.post.bloom.strength > 0;
}

/// True if the exposure follows the light of the frames before.
inline bool adaptsExposure(const ShadingSettings& view)
{
    return view.debug_view == shared::kViewFinal && view.post.automatic_exposure.has_value();
}

/// True if the frame lists material tiles before shading.
inline bool shadesTiles(const Scene& scene, ShadedArea area)
{
    return area == ShadedArea::tiles ||
           (area == ShadedArea::automatic && scene.materials.size() > kWholeFrameMaterials);
}

/// True if the frame uses gathered light (GI).
inline bool usesGi(const Scene& scene, const ShadingSettings& view)
{
    return scene.bricks != nullptr &&
           (view.debug_view == shared::kViewGi || (view.debug_view == shared::kViewFinal && view.gi));
}

class ShadingPass
{
public:
    /// has_final_pass  shades the frames that have one
    /// stored          value of shared::kConstantStored
    static Result<ShadingPass> create(const Device& device, const DrawLayouts& layouts,
                                      const FramePasses& passes, bool has_final_pass, uint32_t stored);

    /// Return the pipelines of a material; creates each variant once and caches it. Call before frames are
    /// recorded.
    Result<ShadingPipelines> prepare(const Device& device, const DrawLayouts& layouts,
                                     const ShadingVariant& variant);

    /// Record in FrameStep::shading, with viewport and scissor set. Clobbers the graphics state.
    void record(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                const Scene& scene, const FrameTargets& targets, const ShadingSettings& view) const;

private:
    Status prepareBrickViews(const Device& device, const DrawLayouts& layouts, const ShadingVariant& variant);
    struct Variant
    {
        UniquePipeline final_pipeline;
        UniquePipeline final_gi_pipeline;
        UniquePipeline debug_view_pipeline;
    };
    void recordSky(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                   const Scene& scene, const FrameTargets& targets, const ShadingSettings& view) const;
    void recordClusterView(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                           const Scene& scene, const FrameTargets& targets,
                           const ShadingSettings& view) const;
    void recordShadowMapView(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                             const Scene& scene, const ShadingSettings& view) const;
    void recordBrickView(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                         const Scene& scene, const ShadingSettings& view) const;
    void recordGiView(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                      const Scene& scene, const ShadingSettings& view) const;
    void recordMaterials(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                         const Scene& scene, const FrameTargets& targets, const ShadingSettings& view) const;

    GraphicsDescription describe(std::span<const uint32_t> fragment, VkPipelineLayout layout) const;
    GraphicsDescription describeSurfaceView(std::span<const uint32_t> fragment,
                                            VkPipelineLayout layout) const;
    DrawConstants drawConstants(const ShadingVariant& variant, bool resolves_only) const;
    void setStencil(const Device& device, VkCommandBuffer commands, uint32_t material) const;

    DrawPlace place_{};
    FrameWay way_ = FrameWay::merged;
    bool has_final_pass_ = false;
    MaterialTest material_test_ = MaterialTest::depth;
    DrawConstants view_constants_{}; ///< of pipelines that reconstruct no surface
    UniquePipeline sky_;
    UniquePipeline cluster_views_;
    /// Set once a scene has shadows: [1] for deformed meshes, [][1] filters the maps.
    UniquePipeline shadow_map_views_[2][2];
    UniquePipeline brick_views_; ///< set once a scene has bricks
    UniquePipeline gi_views_[2]; ///< set once a scene has bricks: [1] for deformed meshes
    std::map<ShadingVariant, Variant> variants_;
};

} // namespace hearth::gpu
