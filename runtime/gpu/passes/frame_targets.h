// Images of a frame, state that one frame leaves to the next (depth pyramid, gathered light), and buffers for
// the lists of material tiles.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/records.h"
#include "runtime/gpu/frame/frame_parts.h"
#include "runtime/gpu/frame/frame_passes.h"
#include "runtime/gpu/passes/gather_targets.h"
#include "runtime/gpu/post/motion_targets.h"
#include "runtime/gpu/post/post_targets.h"
#include "runtime/gpu/post/temporal_targets.h"
#include "runtime/gpu/scene/draw_layouts.h"
#include "runtime/gpu/scene/joined_sets.h"
#include "runtime/gpu/scene/scene_frames.h"

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <vector>

namespace hearth::gpu
{

/// Images of the caller that frames show, each frame one of them: of the renderer's colour format and of the
/// output's size, with one mip and one layer and usage COLOR_ATTACHMENT. They outlive the targets.
struct CallerImages
{
    std::vector<VkImage> images{};
    /// Uses of an image that a frame waits for; its content is lost, whatever the layout.
    ImageState before{};
    /// State after a frame, visible to these accesses; the layout is one that images may be changed to.
    ImageState after{};
};

/// Demands of the frames that are drawn with targets: images that never leave the tile need no memory, and
/// what no frame uses is not created.
struct TargetOptions
{
    /// The most that a frame asks for: off < last_frame < two_phase.
    OcclusionCulling occlusion = OcclusionCulling::two_phase;
    bool keeps_visibility = false; ///< the visibility buffer can be copied after a frame
    bool gathers_light = true;     ///< frames of scenes with bricks gather indirect light
    /// Frames may be split between visibility and shading: material tiles, gathered light, lights listed for
    /// visible pixels, parts.
    bool may_split = true;
    bool counts_missing = false; ///< Renderer::recordMissing may follow a frame: takes a second pyramid
    /// Frames may have a final pass, by a renderer that has them (RendererOptions::post). With an output
    /// of another size, or radiance that is kept, all of them have one.
    bool has_final_pass = false;
    bool may_bloom = false; ///< and bloom or automatic exposure
    /// Size of `color`, to which the final pass enlarges or reduces the frame; 0 x 0: the frame's.
    VkExtent2D output{};
    /// `radiance` can be copied after a frame.
    bool keeps_radiance = false;
    CallerImages colors{}; ///< none: an image of the targets
    /// Paths that the light methods of frames ask for, beside `materials`: bits lightPathBit. `surfaces`
    /// includes surfaces_on_tile; with bloom, automatic exposure or an output of another size methods on the
    /// tile ask for `surfaces`.
    uint32_t light_paths = 0;
    /// MotionPass may follow a frame. Implies keeps_visibility.
    bool has_motion = false;
    /// TemporalPass may follow. Implies has_motion; `output` is the frame's size (asserted).
    bool has_temporal_filter = false;

    bool has(LightPath path) const { return (light_paths & lightPathBit(path)) != 0; }
    /// True if frames with a path have all that it needs.
    bool allows(LightPath path) const
    {
        return path == LightPath::materials || has(path) ||
               (path == LightPath::surfaces_on_tile && has(LightPath::surfaces));
    }
    bool mayStoreSurfaces() const { return has(LightPath::surfaces) || has(LightPath::surfaces_on_tile); }
    bool maySumLights() const
    {
        return has(LightPath::light_sums) || has(LightPath::joint_sums) || has(LightPath::encoded_joint_sums);
    }
};

/// True if every frame with targets of this size has a final pass.
inline bool alwaysHasFinalPass(const TargetOptions& options, VkExtent2D extent)
{
    const bool is_resized = options.output.width != 0 &&
                            (options.output.width != extent.width || options.output.height != extent.height);
    return is_resized || options.keeps_radiance;
}

/// Render targets of one camera. After a frame `color` is in VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, visible to
/// transfers, or as CallerImages says; `visibility`, if it is kept, is in that layout as well. `depth`, if
/// the renderer keeps it, is in VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL after a frame, and has to be before
/// the next one. `radiance`, if it is kept, is in VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, visible to
/// fragments: a copy waits for those by a barrier of the caller's. Before a frame the content and layout of
/// all but a kept depth do not matter.
///
/// The pyramid is a guess: whatever it holds, the rendered frame is the same. The better the guess, the less
/// is drawn.
class FrameTargets
{
public:
    /// width and height: 1 to the device's limits. errors: device_limit, device_failed.
    static Result<FrameTargets> create(const Device& device, const FramePasses& passes,
                                       const DrawLayouts& layouts, VkExtent2D extent,
                                       const TargetOptions& options);

    /// Rendering size.
    VkExtent2D extent() const { return extent_; }
    /// Size of color().
    VkExtent2D outputExtent() const { return color().extent; }
    const TargetOptions& options() const { return options_; }
    /// True if a frame of the configuration uses nothing that the options exclude.
    bool allows(const FrameConfiguration& configuration) const;
    const Image& visibility() const { return visibility_; }
    const Image& depth() const { return depth_; }
    /// Image that the frame begun last shows; without a handle if it is the caller's.
    const Image& color() const { return colors_[color_image_]; }
    /// Choose the image that frames show, of TargetOptions::colors.
    void chooseColor(uint32_t image);
    /// Return what a frame draws with in place of a render pass of its plan: one that leaves `color` as the
    /// caller wants it, if the pass is the one that leaves it.
    VkRenderPass leavingPass(VkRenderPass render_pass) const;
    /// Images of final passes; with TargetOptions::has_final_pass.
    PostTargets& post() { return *post_; }
    const PostTargets& post() const { return *post_; }
    bool hasPost() const { return post_.has_value(); }
    /// Framebuffer of a PassFamily, of the frame begun last.
    VkFramebuffer framebuffer(uint32_t family) const;
    VkExtent2D framebufferExtent(uint32_t family) const { return framebuffers_[family].extent; }
    /// Attachments that shading reads in frames with a path.
    AttachmentSet attachments(LightPath path = LightPath::materials) const
    {
        const PathSet& own = sets_[static_cast<size_t>(path)];
        const PathSet& set = own.set != VK_NULL_HANDLE ? own : sets_[0];
        return {set.set, set.identity};
    }
    /// Images that lights read in frames with a path of TargetOptions::light_paths.
    LitImages litImages(LightPath path) const;
    VkDeviceSize allocatedBytes() const { return arena_.allocatedBytes(); }
    /// Bytes of attachments that exist on the tile only, where the device has lazily allocated memory;
    /// allocatedBytes leaves them out.
    VkDeviceSize transientBytes() const { return arena_.transientBytes(); }

    VkDeviceSize pyramidBytes() const { return pyramids_[0].size + pyramids_[1].size; }
    /// Pyramid that culling tests: floats; layout in formats/gpu_shared/occlusion.h.
    const Buffer& pyramid() const { return pyramids_[pyramid_]; }
    /// Set of the frame that was begun last, with this pyramid.
    VkDescriptorSet occlusionSet() const { return occlusion_[current_].sets[pyramid_]; }
    /// The same with the pyramid that is made next.
    VkDescriptorSet nextOcclusionSet() const { return occlusion_[current_].sets[nextPyramid()]; }
    /// Begin a frame that draws this view: its culling tests boxes in this one and in pyramidView().
    void beginFrame(const shared::FrameView& view);

    /// State of the targets that frames change while they are recorded.
    struct Progress
    {
        uint32_t current = 0;
        uint32_t pyramid = 0;
        shared::OcclusionView pyramid_view{};
        shared::OcclusionView depth_view{};
    };
    Progress progress() const { return {current_, pyramid_, pyramid_view_, depth_view_}; }
    /// Go back to an earlier state: the frames since then are not submitted.
    void restore(const Progress& earlier)
    {
        current_ = earlier.current;
        pyramid_ = earlier.pyramid;
        pyramid_view_ = earlier.pyramid_view;
        depth_view_ = earlier.depth_view;
    }

    /// kMaterialsPerTile words per tile, rows of tiles from top to bottom.
    const Buffer& tileMaterials() const { return tile_materials_; }
    /// Tile lists of the materials, as shared::TileDraw describes.
    const Buffer& tileLists() const { return tile_lists_; }
    VkDescriptorSet tileSet() const { return tile_set_; }
    /// Set of the passes over visible pixels; with TargetOptions::keeps_visibility or may_split.
    VkDescriptorSet pixelSet() const { return pixel_set_; }

    /// Motion vectors; with TargetOptions::has_motion.
    MotionTargets& motion() { return *motion_; }
    const MotionTargets& motion() const { return *motion_; }

    /// Images of the temporal filter; with TargetOptions::has_temporal_filter.
    TemporalTargets& temporal() { return *temporal_; }
    const TemporalTargets& temporal() const { return *temporal_; }

    /// Gathered light (GI); with TargetOptions::gathers_light.
    GatherTargets& gather() { return *gather_; }
    const GatherTargets& gather() const { return *gather_; }

    /// View that the pyramid was rendered from, of an earlier frame. level_count 0: none.
    const shared::OcclusionView& pyramidView() const { return pyramid_view_; }
    /// Invalidate the pyramid ({}), or set the view of a pyramid that the caller has written, at the same
    /// size.
    void setPyramidView(const shared::OcclusionView& view) { pyramid_view_ = view; }
    /// Take the pyramid of nextOcclusionSet(), which was made of this view, in place of pyramid().
    void takeNextPyramid(const shared::OcclusionView& view)
    {
        pyramid_ = nextPyramid();
        pyramid_view_ = view;
    }

    /// View of the depth that the last frame has left for the next one. level_count 0: none.
    const shared::OcclusionView& depthView() const { return depth_view_; }
    void setDepthView(const shared::OcclusionView& view) { depth_view_ = view; }

private:
    // blocks of one resource each: few resources, and none of their memory is to spare
    FrameTargets(const Device& device, VkExtent2D extent, const TargetOptions& options)
        : extent_(extent), options_(options), arena_(device, 0)
    {
    }
    Status createMotion(const Device& device, const DrawLayouts& layouts);
    Status createPost(const Device& device, const FramePasses& passes, const DrawLayouts& layouts);
    Status createImages(const Device& device, const FramePasses& passes);
    std::set<FrameResource> findStored(const FramePasses& passes) const;
    bool needs(FrameResource resource) const;
    Status createFramebuffers(const Device& device, const FramePasses& passes);
    Result<UniqueFramebuffer> createFramebuffer(const Device& device, const PassFamily& family,
                                                uint32_t number) const;
    Status createColors(const Device& device, const FramePasses& passes);
    Status createLeavingPasses(const Device& device, const FramePasses& passes);
    /// Number of images that take turns as one attachment.
    size_t countImages(FrameResource resource) const;
    /// Image of an attachment; its view is null if no frame uses it.
    /// number  of those that take turns
    const Image& attachmentImage(FrameResource resource, uint32_t number = 0) const;
    Status createPyramids(const Device& device);
    uint32_t pyramidCount() const { return options_.counts_missing ? 2 : 1; }
    uint32_t nextPyramid() const { return options_.counts_missing ? 1 - pyramid_ : pyramid_; }
    Status createTileLists(const Device& device);
    Status createSets(const Device& device, const DrawLayouts& layouts);
    Status createAttachmentSets(const Device& device, const DrawLayouts& layouts);

    VkExtent2D extent_;
    TargetOptions options_;
    MemoryArena arena_;
    Image visibility_;
    Image depth_;
    Image surfaces_;               ///< of paths that store them
    std::array<Image, 3> normals_; ///< of paths that sum lights, from FrameResource::normals on
    /// Images of paths that add or mark lights ahead of shading, from FrameResource::diffuse_light on.
    std::array<Image, 5> light_images_;
    bool depth_leaves_tile_ = false;
    UniqueImageView sampled_depth_; ///< without a stencil; empty if no frame reads the depth
    std::vector<Image> colors_;     ///< of the caller, without handles; or the targets' own
    uint32_t color_image_ = 0;
    std::map<VkRenderPass, UniqueRenderPass> leaving_passes_; ///< [pass of a plan]
    // texels in place of images that no frame reads: some drivers look at all descriptors of a set
    Image no_depth_, no_light_, no_light_image_;
    std::optional<PostTargets> post_; ///< with TargetOptions::has_final_pass
    struct FamilyFramebuffer
    {
        VkExtent2D extent{};
        FrameResource turning = FrameResource::count; ///< attachment of which images take turns
        std::vector<UniqueFramebuffer> handles{};     ///< [image]
    };
    std::vector<FamilyFramebuffer> framebuffers_; ///< [family]; empty if no frame uses it
    Buffer pyramids_[2];                          ///< the second with TargetOptions::counts_missing
    uint32_t pyramid_ = 0;                        ///< that culling tests
    Buffer tile_materials_;
    Buffer tile_lists_;
    UniqueSampler texel_sampler_;
    UniqueDescriptorPool pool_;
    struct PathSet
    {
        VkDescriptorSet set = VK_NULL_HANDLE;
        std::shared_ptr<const TargetsIdentity> identity = std::make_shared<TargetsIdentity>();
    };
    std::array<PathSet, kLightPathCount> sets_; ///< [LightPath]; that of `materials` stands for empty ones
    /// Views of a frame's occlusion tests, for each frame in flight.
    struct OcclusionViews
    {
        Buffer views;                 ///< two OcclusionView; mapped
        VkDescriptorSet sets[2] = {}; ///< [pyramid]
    };
    OcclusionViews occlusion_[kMaxFramesInFlight];
    uint32_t current_ = 0;
    VkDescriptorSet tile_set_ = VK_NULL_HANDLE;
    VkDescriptorSet pixel_set_ = VK_NULL_HANDLE;
    shared::OcclusionView pyramid_view_{};
    shared::OcclusionView depth_view_{};
    std::optional<GatherTargets> gather_;     ///< with TargetOptions::gathers_light
    std::optional<MotionTargets> motion_;     ///< with TargetOptions::has_motion
    std::optional<TemporalTargets> temporal_; ///< with TargetOptions::has_temporal_filter
};

} // namespace hearth::gpu
