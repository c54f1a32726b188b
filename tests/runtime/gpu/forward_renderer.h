// The last frame of a scene drawn again in other ways, for tests to compare with: forward, and its UV derivatives.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/scene/scene.h"
#include "runtime/viewer/vulkan_host.h"

namespace hearth::test
{

/// Reads what the frame has left in the buffers of the scene. The frame was drawn without kCullOcclusion: with it, the
/// draws of its early phase are gone.
class ForwardRenderer
{
public:
    ForwardRenderer(viewer::VulkanHost& host, const gpu::Device& device);

    /// The visible list, each material with a pipeline of its own, shaded as it is drawn: RGBA8 sRGB. The background is 0.
    /// Opaque materials with vertex normals, and tangents where there is a normal map.
    std::vector<uint32_t> draw(const gpu::Scene& scene, VkExtent2D extent);

    /// (du/dx, dv/dx, du/dy, dv/dy) of UV set 0 in every pixel, per pixel; 0 where there is nothing.
    std::vector<std::array<float, 4>> uvDerivatives(const gpu::Scene& scene,
                                                    const gpu::FrameTargets& targets);

private:
    void begin(VkCommandBuffer commands, VkRenderPass pass, VkFramebuffer framebuffer,
               VkExtent2D extent) const;
    void drawMaterial(VkCommandBuffer commands, const gpu::Scene& scene, uint32_t row, uint32_t bin,
                      VkPipeline pipeline) const;
    gpu::UniquePipeline createPipeline(const gpu::Scene& scene, uint32_t row, gpu::Facing facing) const;

    viewer::VulkanHost& host_;
    const gpu::Device& device_;
    gpu::DrawLayouts layouts_;
    gpu::UniqueRenderPass forward_pass_;
    gpu::UniqueRenderPass derivatives_pass_;
};

} // namespace hearth::test
