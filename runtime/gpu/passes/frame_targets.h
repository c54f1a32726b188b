// Images of a frame, state that one frame leaves to the next (depth pyramid, gathered light), and buffers for
// the lists of material tiles.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/records.h"
#include "runtime/gpu/passes/frame_passes.h"
#include "runtime/gpu/passes/gather_targets.h"
#include "runtime/gpu/scene/draw_layouts.h"

#include <optional>

namespace hearth::gpu
{

/// Render targets of one camera. After a frame, `visibility` and `color` are in
/// VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, visible to transfers. Before a frame their content and layout do not
/// matter.
///
/// The pyramid is a guess: whatever it holds, the rendered frame is the same. The better the guess, the less
/// is drawn.
class FrameTargets
{
public:
    /// width and height: 1 to the device's limits. `render_pass`: one of FramePasses.
    /// errors: device_limit, device_failed.
    static Result<FrameTargets> create(const Device& device, VkRenderPass render_pass,
                                       const DrawLayouts& layouts, VkExtent2D extent);

    VkExtent2D extent() const { return extent_; }
    const Image& visibility() const { return visibility_; }
    const Image& color() const { return color_; }
    VkFramebuffer framebuffer() const { return framebuffer_.get(); }
    VkDescriptorSet attachments() const { return set_; }
    VkDeviceSize allocatedBytes() const { return arena_.allocatedBytes(); }

    const Buffer& pyramid() const { return pyramid_; } ///< floats; layout in formats/gpu_shared/occlusion.h
    const Buffer& occlusionViews() const { return occlusion_views_; }
    VkDescriptorSet occlusionSet() const { return occlusion_set_; }

    /// kMaterialsPerTile words per tile, rows of tiles from top to bottom.
    const Buffer& tileMaterials() const { return tile_materials_; }
    /// Tile lists of the materials, as shared::TileDraw describes.
    const Buffer& tileLists() const { return tile_lists_; }
    VkDescriptorSet tileSet() const { return tile_set_; }

    /// Gathered light (GI); only for scenes with bricks.
    GatherTargets& gather() { return *gather_; }
    const GatherTargets& gather() const { return *gather_; }

    /// View that the pyramid was rendered from: the last frame with occlusion culling. level_count 0: none.
    const shared::OcclusionView& pyramidView() const { return pyramid_view_; }
    /// Invalidate the pyramid ({}), or set the view of a pyramid that the caller has written, at the same
    /// size.
    void setPyramidView(const shared::OcclusionView& view) { pyramid_view_ = view; }

private:
    FrameTargets(const Device& device, VkExtent2D extent) : extent_(extent), arena_(device) {}
    Status createImages();
    Status createFramebuffer(const Device& device, VkRenderPass render_pass);
    Status createPyramid(const Device& device);
    Status createTileLists(const Device& device);
    Status createSets(const Device& device, const DrawLayouts& layouts);

    VkExtent2D extent_;
    MemoryArena arena_;
    Image visibility_;
    Image depth_;
    Image material_depth_;
    Image color_;
    UniqueFramebuffer framebuffer_;
    Buffer pyramid_;
    Buffer occlusion_views_; ///< two OcclusionView
    Buffer tile_materials_;
    Buffer tile_lists_;
    UniqueSampler texel_sampler_;
    UniqueDescriptorPool pool_;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
    VkDescriptorSet occlusion_set_ = VK_NULL_HANDLE;
    VkDescriptorSet tile_set_ = VK_NULL_HANDLE;
    shared::OcclusionView pyramid_view_{};
    std::optional<GatherTargets> gather_; ///< set after creation
};

} // namespace hearth::gpu
