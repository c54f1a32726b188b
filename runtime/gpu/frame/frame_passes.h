// Render passes made from the table of a frame. Those of a family have the same attachments and subpasses, so
// that they share pipelines and framebuffers: all passes of the ways with subpasses, where a pass that only
// fills the visibility buffer, or only shades, leaves its other subpass empty; with FrameWay::separate those
// that fill the visibility buffer, and those that shade.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/frame/frame_plan.h"
#include "runtime/gpu/vulkan/device.h"

#include <map>

namespace hearth::gpu
{

inline constexpr VkFormat kVisibilityFormat = VK_FORMAT_R32_UINT;
/// Words that runtime/shaders/shade/surface_words.glsl packs.
inline constexpr VkFormat kSurfacesFormat = VK_FORMAT_R32G32B32A32_UINT;
/// Texels that runtime/shaders/prepass/normal_texel.glsl packs. Every device draws and samples them.
constexpr VkFormat normalsFormat(FrameResource normals)
{
    return normals == FrameResource::normals         ? VK_FORMAT_R32G32_UINT
           : normals == FrameResource::joint_normals ? VK_FORMAT_A2B10G10R10_UNORM_PACK32
                                                     : VK_FORMAT_R16G16B16A16_SFLOAT;
}
/// Sums of light, and bits of lights: every device blends both.
inline constexpr VkFormat kLightSumFormat = VK_FORMAT_R16G16B16A16_SFLOAT;
inline constexpr VkFormat kLightBitsFormat = VK_FORMAT_R8G8B8A8_UNORM;
/// Stops of automatic exposure.
inline constexpr VkFormat kExposureFormat = VK_FORMAT_R32_SFLOAT;
/// Depth and, with MaterialTest::id, a stencil of the low bits of material numbers.
constexpr VkFormat depthFormat(MaterialTest materials)
{
    return materials == MaterialTest::id ? VK_FORMAT_D32_SFLOAT_S8_UINT : VK_FORMAT_D32_SFLOAT;
}

/// A render pass of a plan.
struct PlannedPass
{
    VkRenderPass render_pass = VK_NULL_HANDLE; ///< null: another pass
    uint32_t family = 0;                       ///< of a pass of the frame's size
};

/// A frame, and its render passes.
struct FramePlan
{
    FrameDescription description;
    std::vector<PlannedPass> render_passes; ///< [pass]
};

/// Compatible render passes.
struct PassFamily
{
    std::vector<FrameResource> attachments;    ///< of framebuffers, in this order
    std::vector<std::vector<Access>> accesses; ///< [subpass], in the order of its attachments
    VkRenderPass any_pass = VK_NULL_HANDLE;
};

/// Place of a pipeline's draws.
struct DrawPlace
{
    VkRenderPass render_pass;
    uint32_t subpass;
};

/// Facts that all frames of a renderer share.
struct FramePassOptions
{
    FrameWay way = FrameWay::merged;
    MaterialTest materials = MaterialTest::depth;
    /// As FrameConfiguration, of frames with a final pass; none: there are no such frames.
    std::optional<VkFormat> radiance_format{};
    bool deferred = false;    ///< there are frames that light stored surfaces; they have a final pass
    bool keeps_depth = false; ///< as FrameConfiguration
    VkFormat color_format = kColorFormat;
};

/// Plans of all configurations, made before any frame is recorded. They have the light of bricks, lists of
/// lights, and for scenes with shadows maps of all kinds: a frame records what it needs of them.
class FramePasses
{
public:
    /// errors: device_failed.
    static Result<FramePasses> create(const Device& device, const FramePassOptions& options);

    FrameWay way() const { return options_.way; }
    MaterialTest materials() const { return options_.materials; }
    FrameFeatures features() const { return features_; }
    bool keepsDepth() const { return options_.keeps_depth; }
    VkFormat colorFormat() const { return options_.color_format; }
    bool hasFinalPasses() const { return features_ >= FrameFeatures::finished; }
    /// True if the output is one of the frames' that the passes draw.
    bool has(ShadedOutput output) const;
    VkFormat radianceFormat() const { return options_.radiance_format.value_or(kPackedRadiance); }
    /// Plan of a configuration; its way, its test of materials, its bricks and its maps do not matter, nor do
    /// lists of lights ahead of the visibility buffer.
    const FramePlan& plan(const FrameConfiguration& configuration) const;
    /// Families of the passes of the frame's size.
    std::span<const PassFamily> families() const { return families_; }
    /// Return the place of pipelines of a step in frames whose shading has this output.
    DrawPlace place(ShadedOutput output, FrameStep step) const;
    /// Return the place of pipelines of a step behind shading.
    DrawPlace filterPlace(FrameStep step) const
    {
        return findPlace(plan({.has_final_pass = true, .adapts_exposure = true, .blooms = true}), step);
    }
    /// Return a render pass that draws a shadow map of a format; all of it are compatible.
    VkRenderPass shadowMapPass(VkFormat format) const;
    /// Create a render pass like one of a plan that leaves `color` in this layout. errors: device_failed.
    Result<UniqueRenderPass> createLeaving(const Device& device, const Pass& pass, VkImageLayout color) const;

private:
    /// Format of a shadow map; load and store operations and layouts of the attachments.
    using Key = std::vector<uint32_t>;
    Result<PlannedPass> findOrCreate(const Device& device, const Pass& pass);
    /// Number of a plan: those of a configuration are without shadows, with 32-bit maps, with 16-bit maps.
    static size_t planNumber(const FrameConfiguration& configuration);
    /// Any plan will do: passes of a family have the same subpasses.
    static DrawPlace findPlace(const FramePlan& plan, FrameStep step);

    FramePassOptions options_;
    FrameFeatures features_ = FrameFeatures::shaded;
    std::vector<FramePlan> plans_; ///< [planNumber]
    std::vector<PassFamily> families_;
    struct CreatedPass
    {
        UniqueRenderPass handle;
        uint32_t family = 0;
    };
    std::map<Key, CreatedPass> passes_;
};

} // namespace hearth::gpu
