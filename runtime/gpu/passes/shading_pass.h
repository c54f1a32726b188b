// Shades the frame: the sky, then each visible material in its own pixels, which the depth test or the
// stencil finds. Follows the material marks.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/ambient_occlusion.h"
#include "formats/gpu_shared/shading.h"
#include "runtime/gpu/materials/material_shaders.h"
#include "runtime/gpu/passes/frame_targets.h"
#include "runtime/gpu/post/post_settings.h"
#include "runtime/gpu/scene/scene.h"
#include "runtime/shaders/shaders.h"

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

/// Return the method by which the frame adds its lights: debug views that shade nothing have the default.
inline LightMethod lightMethod(const ShadingSettings& view)
{
    return view.debug_view == shared::kViewFinal ||
                   lightMethodFacts(view.light_method).path == LightPath::materials
               ? view.light_method
               : LightMethod::practical;
}

/// Return the place of the frame's lights. On the tile nothing lies behind them but the pixel's final pass.
inline LightPath neededLightPath(const FrameTargets& targets, const ShadingSettings& view)
{
    const LightPath path = lightMethodFacts(lightMethod(view)).path;
    const bool leaves_tile =
        usesBloom(view) || adaptsExposure(view) || alwaysHasFinalPass(targets.options(), targets.extent());
    return path == LightPath::surfaces_on_tile && leaves_tile ? LightPath::surfaces : path;
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
    /// functions  of the game, outlive the pass; or null
    static Result<ShadingPass> create(const Device& device, const DrawLayouts& layouts,
                                      const FramePasses& passes, ShadedOutput output,
                                      const StoredColor& color, const MaterialShaders* functions);

    /// Return the pipelines of a material; creates each variant once and caches it. Call before frames are
    /// recorded. Frames that light stored surfaces show no debug views, and have no pipelines for them.
    Result<ShadingPipelines> prepare(const Device& device, const DrawLayouts& layouts,
                                     const ShadingVariant& variant);

    /// Record in FrameStep::normals, of outputs with that step: store what lights need of surfaces.
    void recordNormals(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                       const Scene& scene, const FrameTargets& targets, const ShadingSettings& view) const;

    /// Record in FrameStep::shading, with viewport and scissor set. Clobbers the graphics state.
    void record(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                const Scene& scene, const FrameTargets& targets, const ShadingSettings& view) const;

private:
    Status prepareViews(const Device& device, const DrawLayouts& layouts, const ShadingVariant& variant);
    Status prepareBrickViews(const Device& device, const DrawLayouts& layouts, const ShadingVariant& variant);
    struct Variant
    {
        UniquePipeline normals_pipeline;
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
    /// Pipeline of a material that a draw of all materials uses.
    using MaterialPipeline = VkPipeline ShadingPipelines::*;
    void recordMaterials(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                         const Scene& scene, const FrameTargets& targets, const ShadingSettings& view,
                         MaterialPipeline pipeline) const;
    Status createNormals(const Device& device, const DrawLayouts& layouts, const ShadingVariant& variant,
                         UniquePipeline& pipeline) const;

    const shaders::VariedShader& materialShader(bool shadowed, bool gi) const;
    Result<std::span<const uint32_t>> findWords(const shaders::VariedShader& shader,
                                                const ShadingVariant& variant) const;
    GraphicsDescription describe(std::span<const uint32_t> fragment, VkPipelineLayout layout) const;
    GraphicsDescription describeSurfaceView(std::span<const uint32_t> fragment,
                                            VkPipelineLayout layout) const;
    DrawConstants drawConstants(const ShadingVariant& variant, bool resolves_only) const;
    void setStencil(const Device& device, VkCommandBuffer commands, uint32_t material) const;

    const MaterialShaders* functions_ = nullptr;
    DrawPlace place_{};
    DrawPlace normals_place_{}; ///< of outputs that sum lights
    FrameWay way_ = FrameWay::merged;
    ShadedOutput output_ = ShadedOutput::color;
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
