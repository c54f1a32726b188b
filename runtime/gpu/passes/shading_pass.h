// Shades the picture: the sky, then each material that is seen, where the material depth is its own. Third subpass.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/ambient_occlusion.h"
#include "formats/gpu_shared/shading.h"
#include "runtime/gpu/passes/frame_targets.h"
#include "runtime/gpu/scene/scene.h"

#include <map>

namespace hearth::gpu
{

/// Where each material is shaded. The picture is the same.
enum class ShadedArea : uint8_t
{
    automatic,    ///< the tiles where it is seen, in scenes of more than kWholePictureMaterials
    wholePicture, ///< everywhere: pixels of other materials fail the depth test
    tiles,        ///< the tiles where it is seen
};

/// Up to so many materials a scene is shaded in one render pass. See runtime/gpu/README.md, "Material tiles".
inline constexpr uint32_t kWholePictureMaterials = 8;

/// What the picture shows.
struct ShadingView
{
    uint32_t shown = shared::kViewFinal; ///< one of shared::kView*
    float depth_scale = 1;               ///< metres that the depth view shows as middle grey
    ShadedArea area = ShadedArea::automatic;
    uint32_t ambient_occlusion = shared::kAmbientOcclusionExact; ///< of meshes with visibility
    uint32_t specular_occlusion = shared::kSpecularOcclusionFit; ///< the same
    bool bricks_light = true; ///< of scenes with bricks: their light is gathered, else the sky is constant
};

/// Whether the frame makes lists of tiles before it is shaded.
inline bool shadesTiles(const Scene& scene, ShadedArea area)
{
    return area == ShadedArea::tiles ||
           (area == ShadedArea::automatic && scene.materials.size() > kWholePictureMaterials);
}

/// Whether the picture shows light that is gathered from bricks.
inline bool gathers(const Scene& scene, const ShadingView& view)
{
    return scene.bricks != nullptr &&
           (view.shown == shared::kViewGathered || (view.shown == shared::kViewFinal && view.bricks_light));
}

/// Whether the picture needs bricks, which not all scenes have.
inline bool showsBricks(uint32_t shown)
{
    return shown == shared::kViewBricks || shown == shared::kViewBrickLighting ||
           shown == shared::kViewGathered;
}

class ShadingPass
{
public:
    static Result<ShadingPass> create(const Device& device, const DrawLayouts& layouts,
                                      VkRenderPass render_pass);

    /// The pipelines of a material; made once for each variant and kept. To be called before frames are recorded.
    Result<ShadingPipelines> prepare(const Device& device, const DrawLayouts& layouts,
                                     const ShadingVariant& variant);

    /// Inside subpass kSubpassShading, with viewport and scissor set. Clobbers the graphics state.
    void record(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                const Scene& scene, const FrameTargets& targets, const ShadingView& view) const;

private:
    Status prepareBricks(const Device& device, const DrawLayouts& layouts, const ShadingVariant& variant);
    struct Variant
    {
        UniquePipeline final_view;
        UniquePipeline gathered_view;
        UniquePipeline inspection;
    };
    void recordSky(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                   const Scene& scene, const FrameTargets& targets, const ShadingView& view) const;
    void recordClusters(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                        const Scene& scene, const FrameTargets& targets, const ShadingView& view) const;
    void recordShadowMaps(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                          const Scene& scene, const ShadingView& view) const;
    void recordBricks(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                      const Scene& scene, const ShadingView& view) const;
    void recordGathered(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                        const Scene& scene, const ShadingView& view) const;
    void recordMaterials(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                         const Scene& scene, const ShadingView& view) const;

    VkRenderPass render_pass_ = VK_NULL_HANDLE;
    UniquePipeline sky_;
    UniquePipeline clusters_;
    UniquePipeline shadow_maps_[2]; ///< once a scene has them: [1] one with deformed meshes
    UniquePipeline bricks_;         ///< once a scene has them
    UniquePipeline gathered_[2];    ///< as shadow_maps_, once a scene has bricks
    std::map<ShadingVariant, Variant> variants_;
};

} // namespace hearth::gpu
