// Draws the last frame of a scene again by other methods, for comparison in tests: forward shading, and its
// UV derivatives.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/scene/scene.h"
#include "runtime/viewer/vulkan_host.h"

namespace hearth::test
{

/// Reads the data that the frame left in the scene's buffers. The frame must be drawn without kCullOcclusion:
/// with it, the draws of the early phase are lost.
class ForwardRenderer
{
public:
    ForwardRenderer(viewer::VulkanHost& host, const gpu::Device& device);

    /// Draw the visible list with forward shading and one pipeline for each material: RGBA8 sRGB. The
    /// background is 0. Opaque materials with vertex normals, and tangents if there is a normal map.
    std::vector<uint32_t> draw(const gpu::Scene& scene, VkExtent2D extent);

    /// (du/dx, dv/dx, du/dy, dv/dy) of UV set 0 for every pixel, per pixel; 0 for the background.
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
    gpu::UniquePipelineLayout forward_layout_;
    gpu::UniqueRenderPass forward_pass_;
    gpu::UniqueRenderPass derivatives_pass_;
};

} // namespace hearth::test
