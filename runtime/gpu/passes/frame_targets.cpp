// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/passes/frame_targets.h"

#include "formats/gpu_shared/material_tiles.h"
#include "formats/gpu_shared/occlusion.h"
#include "runtime/frame/frame.h"
#include "runtime/gpu/frame/frame_plan.h"
#include "runtime/gpu/vulkan/sampler.h"

#include <algorithm>
#include <cstring>
#include <set>
#include <string>

namespace hearth::gpu
{

namespace
{

/// Create an image of one texel, which nobody reads.
Result<Image> createTexel(MemoryArena& arena, VkFormat format)
{
    return arena.createImage({.format = format, .extent = {1, 1}, .usage = VK_IMAGE_USAGE_SAMPLED_BIT});
}

/// Create a view of one aspect of an image of one mip and layer.
Result<UniqueImageView> createAspectView(const Device& device, VkImage image, VkFormat format,
                                         VkImageAspectFlags aspect)
{
    VkImageViewCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    info.image = image;
    info.viewType = VK_IMAGE_VIEW_TYPE_2D;
    info.format = format;
    info.subresourceRange = {aspect, 0, 1, 0, 1};
    VkImageView view;
    HEARTH_TRY_VK(device.vk.vkCreateImageView(device.handle, &info, device.allocator, &view),
                  "create an image view");
    return UniqueImageView(device, view);
}

} // namespace

Result<FrameTargets> FrameTargets::create(const Device& device, const FramePasses& passes,
                                          const DrawLayouts& layouts, VkExtent2D extent,
                                          const TargetOptions& options)
{
    for (const VkExtent2D size : {extent, options.output})
        if (size.width > device.limits.maxFramebufferWidth ||
            size.height > device.limits.maxFramebufferHeight ||
            std::max(size.width, size.height) > device.limits.maxImageDimension2D)
            return Error{Issue::device_limit, "", "",
                         "the device cannot render " + std::to_string(size.width) + "x" +
                             std::to_string(size.height) + " pixels"};
    FrameTargets t(device, extent, options);
    t.options_.has_motion = options.has_motion || options.has_temporal_filter;
    t.options_.keeps_visibility = options.keeps_visibility || t.options_.has_motion;
    HEARTH_TRY(t.createPost(device, passes, layouts));
    HEARTH_TRY(t.createImages(device, passes));
    HEARTH_TRY(t.createLeavingPasses(device, passes));
    HEARTH_TRY(t.createFramebuffers(device, passes));
    HEARTH_TRY(t.createPyramids(device));
    HEARTH_TRY(t.createTileLists(device));
    HEARTH_TRY(t.createSets(device, layouts));
    HEARTH_TRY(t.createMotion(device, layouts));
    return t;
}

/// Create the images of motion vectors and of the temporal filter, if frames may have them.
Status FrameTargets::createMotion(const Device& device, const DrawLayouts& layouts)
{
    const bool is_filtered = options_.has_temporal_filter;
    if (options_.has_motion)
    {
        HEARTH_ASSIGN_OR_RETURN(motion_, MotionTargets::create(device, arena_, extent_, is_filtered));
    }
    if (!is_filtered)
        return success();
    HEARTH_ASSERT(options_.colors.images.empty() && color().extent.width == extent_.width &&
                  color().extent.height == extent_.height);
    HEARTH_ASSIGN_OR_RETURN(temporal_, TemporalTargets::create(device, layouts, arena_, *motion_, color()));
    return success();
}

/// Create the images of final passes, if frames may have one.
Status FrameTargets::createPost(const Device& device, const FramePasses& passes, const DrawLayouts& layouts)
{
    const bool stores_surfaces = options_.mayStoreSurfaces();
    const bool is_sampled =
        options_.has(LightPath::surfaces) || (stores_surfaces && !hasSubpasses(passes.way()));
    options_.has_final_pass =
        options_.has_final_pass || options_.may_bloom || is_sampled || alwaysHasFinalPass(options_, extent_);
    HEARTH_ASSERT(passes.hasFinalPasses() || !options_.has_final_pass);
    HEARTH_ASSERT(passes.features() == FrameFeatures::deferred || options_.light_paths == 0);
    if (!options_.has_final_pass && !stores_surfaces)
        return success();
    const PostUses uses{.leaves_tile = options_.has_final_pass,
                        .is_input = stores_surfaces && hasSubpasses(passes.way()),
                        .may_bloom = options_.may_bloom,
                        .keeps_radiance = options_.keeps_radiance};
    HEARTH_ASSIGN_OR_RETURN(post_, PostTargets::create(device, passes, layouts, arena_, extent_, uses));
    return success();
}

bool FrameTargets::allows(const FrameConfiguration& c) const
{
    const bool splits = c.material_tiles || c.gathers_light || c.lists_visible || c.in_parts;
    const bool may_finish = options_.has_final_pass || storesSurfaces(c.light_path);
    if (c.has_final_pass ? !may_finish : alwaysHasFinalPass(options_, extent_))
        return false;
    if (c.light_path == LightPath::surfaces_on_tile && alwaysHasFinalPass(options_, extent_))
        return false;
    if ((c.blooms || c.adapts_exposure) && !options_.may_bloom)
        return false;
    if (!options_.allows(c.light_path))
        return false;
    return c.occlusion <= options_.occlusion && (!c.keeps_visibility || options_.keeps_visibility) &&
           (!c.gathers_light || options_.gathers_light) && (!splits || options_.may_split);
}

/// Return the attachments that an allowed frame loads or stores.
std::set<FrameResource> FrameTargets::findStored(const FramePasses& passes) const
{
    std::set<FrameResource> stored;
    for (const FrameConfiguration& c : allConfigurations(passes.way(), passes.materials(), passes.features()))
        if (allows(c))
            for (const Pass& pass : passes.plan(c).description.passes)
                for (const AttachmentUse& use : pass.attachments)
                    if (use.store || use.load == LoadOperation::load)
                        stored.insert(use.resource);
    return stored;
}

/// True if allowed frames have an image of stored surfaces, or one that lights are added to or marked in.
bool FrameTargets::needs(FrameResource resource) const
{
    switch (resource)
    {
    case FrameResource::surfaces:
        return options_.mayStoreSurfaces();
    case FrameResource::normals:
    case FrameResource::specular_light:
    case FrameResource::grazing_light:
        return options_.has(LightPath::light_sums);
    case FrameResource::joint_normals:
        return options_.has(LightPath::joint_sums);
    case FrameResource::encoded_normals:
        return options_.has(LightPath::encoded_joint_sums);
    case FrameResource::diffuse_light:
        return options_.maySumLights();
    default:
        return options_.has(LightPath::light_bits);
    }
}

/// Create the attachments. Those that no allowed frame loads or stores exist on the tile only.
Status FrameTargets::createImages(const Device& device, const FramePasses& passes)
{
    const std::set<FrameResource> leave_tile = findStored(passes);
    VkExtent2D extent = extent_;
    const auto create = [&](Image& image, FrameResource resource, VkFormat format, VkImageUsageFlags usage,
                            VkImageUsageFlags usage_in_memory, VkImageAspectFlags aspect) -> Status
    {
        const bool on_tile = !leave_tile.contains(resource);
        HEARTH_ASSIGN_OR_RETURN(
            image, arena_.createImage(
                       {.format = format,
                        .extent = extent,
                        .usage = usage | (on_tile ? VkImageUsageFlags{VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT}
                                                  : usage_in_memory),
                        .aspect = aspect,
                        .kind = on_tile ? MemoryKind::transient : MemoryKind::device}));
        return success();
    };
    constexpr VkImageUsageFlags kInput = VK_IMAGE_USAGE_INPUT_ATTACHMENT_BIT;
    const VkImageUsageFlags input = hasSubpasses(passes.way()) ? kInput : 0;
    HEARTH_TRY(create(visibility_, FrameResource::visibility, kVisibilityFormat,
                      VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | input,
                      VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                      VK_IMAGE_ASPECT_COLOR_BIT));
    const bool has_stencil = passes.materials() == MaterialTest::id;
    HEARTH_TRY(create(depth_, FrameResource::depth, depthFormat(passes.materials()),
                      VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | (options_.light_paths != 0 ? kInput : 0),
                      VK_IMAGE_USAGE_SAMPLED_BIT |
                          (passes.keepsDepth() ? VkImageUsageFlags{VK_IMAGE_USAGE_TRANSFER_SRC_BIT} : 0),
                      VK_IMAGE_ASPECT_DEPTH_BIT | (has_stencil ? VK_IMAGE_ASPECT_STENCIL_BIT : 0)));
    const auto create_lit = [&](Image& image, FrameResource resource, VkFormat format) -> Status
    {
        if (needs(resource))
            HEARTH_TRY(create(image, resource, format, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | input,
                              VK_IMAGE_USAGE_SAMPLED_BIT, VK_IMAGE_ASPECT_COLOR_BIT));
        return success();
    };
    HEARTH_TRY(create_lit(surfaces_, FrameResource::surfaces, kSurfacesFormat));
    for (size_t i = 0; i < normals_.size(); ++i)
    {
        const auto resource = static_cast<FrameResource>(static_cast<size_t>(FrameResource::normals) + i);
        HEARTH_TRY(create_lit(normals_[i], resource, normalsFormat(resource)));
    }
    depth_leaves_tile_ = leave_tile.contains(FrameResource::depth);
    for (size_t i = 0; i < light_images_.size(); ++i)
    {
        const auto resource =
            static_cast<FrameResource>(static_cast<size_t>(FrameResource::diffuse_light) + i);
        const VkFormat format =
            resource >= FrameResource::low_light_bits ? kLightBitsFormat : kLightSumFormat;
        if (needs(resource))
            HEARTH_TRY(create(light_images_[i], resource, format,
                              VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | kInput, 0, VK_IMAGE_ASPECT_COLOR_BIT));
    }
    if (depth_leaves_tile_ || options_.light_paths != 0)
    {
        // without a stencil, to be sampled
        HEARTH_ASSIGN_OR_RETURN(sampled_depth_, createAspectView(device, depth_.handle.get(), depth_.format,
                                                                 VK_IMAGE_ASPECT_DEPTH_BIT));
    }
    return createColors(device, passes);
}

/// Create the image that frames show, or views of the caller's.
Status FrameTargets::createColors(const Device& device, const FramePasses& passes)
{
    const VkExtent2D extent = options_.output.width != 0 ? options_.output : extent_;
    const VkFormat format = passes.colorFormat();
    for (const VkImage image : options_.colors.images)
    {
        Image& color = colors_.emplace_back();
        color.format = format;
        color.extent = extent;
        HEARTH_ASSIGN_OR_RETURN(color.view,
                                createAspectView(device, image, format, VK_IMAGE_ASPECT_COLOR_BIT));
    }
    if (!colors_.empty())
        return success();
    const VkImageUsageFlags filtered =
        options_.has_temporal_filter ? VkImageUsageFlags{VK_IMAGE_USAGE_SAMPLED_BIT} : 0;
    HEARTH_ASSIGN_OR_RETURN(Image own,
                            arena_.createImage({.format = format,
                                                .extent = extent,
                                                .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                                         VK_IMAGE_USAGE_TRANSFER_SRC_BIT | filtered}));
    colors_.push_back(std::move(own));
    return success();
}

/// Create the render passes that leave an image of the caller in its state.
Status FrameTargets::createLeavingPasses(const Device& device, const FramePasses& passes)
{
    if (options_.colors.images.empty())
        return success();
    for (const FrameConfiguration& c : allConfigurations(passes.way(), passes.materials(), passes.features()))
    {
        if (!allows(c))
            continue;
        const FramePlan& plan = passes.plan(c);
        for (size_t i = 0; i < plan.render_passes.size(); ++i)
        {
            const Pass& pass = plan.description.passes[i];
            const bool leaves_color = std::any_of(
                pass.attachments.begin(), pass.attachments.end(),
                [](const AttachmentUse& use) { return use.resource == FrameResource::color && use.store; });
            const VkRenderPass handle = plan.render_passes[i].render_pass;
            if (!leaves_color || leaving_passes_.contains(handle))
                continue;
            HEARTH_ASSIGN_OR_RETURN(leaving_passes_[handle],
                                    passes.createLeaving(device, pass, options_.colors.after.layout));
        }
    }
    return success();
}

VkRenderPass FrameTargets::leavingPass(VkRenderPass render_pass) const
{
    const auto found = leaving_passes_.find(render_pass);
    return found == leaving_passes_.end() ? render_pass : found->second.get();
}

void FrameTargets::chooseColor(uint32_t image)
{
    HEARTH_ASSERT(image < colors_.size());
    color_image_ = image;
}

size_t FrameTargets::countImages(FrameResource resource) const
{
    return resource == FrameResource::color ? colors_.size() : resource == FrameResource::exposure ? 2 : 1;
}

const Image& FrameTargets::attachmentImage(FrameResource resource, uint32_t number) const
{
    static const Image kNone{};
    switch (resource)
    {
    case FrameResource::visibility:
        return visibility_;
    case FrameResource::depth:
        return depth_;
    case FrameResource::color:
        return colors_[number];
    case FrameResource::surfaces:
        return surfaces_;
    case FrameResource::normals:
    case FrameResource::joint_normals:
    case FrameResource::encoded_normals:
        return normals_[static_cast<size_t>(resource) - static_cast<size_t>(FrameResource::normals)];
    case FrameResource::diffuse_light:
    case FrameResource::specular_light:
    case FrameResource::grazing_light:
    case FrameResource::low_light_bits:
    case FrameResource::high_light_bits:
        return light_images_[static_cast<size_t>(resource) -
                             static_cast<size_t>(FrameResource::diffuse_light)];
    case FrameResource::exposure:
        return post_ ? post_->exposureImage(number) : kNone;
    default:
        return post_ ? post_->image(resource) : kNone;
    }
}

LitImages FrameTargets::litImages(LightPath path) const
{
    // marks of lights read the depth alone
    const Image& lit = storesSurfaces(path) ? surfaces_
                       : sumsLights(path)   ? attachmentImage(normalsImage(path))
                                            : visibility_;
    return {lit.view.get(), sampled_depth_.get(), texel_sampler_.get(),
            sets_[static_cast<size_t>(path)].identity};
}

VkFramebuffer FrameTargets::framebuffer(uint32_t family) const
{
    const FamilyFramebuffer& framebuffer = framebuffers_[family];
    const uint32_t number = framebuffer.turning == FrameResource::color      ? color_image_
                            : framebuffer.turning == FrameResource::exposure ? post_->exposureNumber()
                                                                             : 0;
    HEARTH_ASSERT(number < framebuffer.handles.size());
    return framebuffer.handles[number].get();
}

/// Create no framebuffer of attachments that no frame uses, or not together.
Status FrameTargets::createFramebuffers(const Device& device, const FramePasses& passes)
{
    for (const PassFamily& family : passes.families())
    {
        FamilyFramebuffer& framebuffer = framebuffers_.emplace_back();
        framebuffer.extent = attachmentImage(family.attachments.front()).extent;
        const bool is_used = std::all_of(family.attachments.begin(), family.attachments.end(),
                                         [&](FrameResource resource)
                                         {
                                             const Image& image = attachmentImage(resource);
                                             return image.view.get() != VK_NULL_HANDLE &&
                                                    image.extent.width == framebuffer.extent.width &&
                                                    image.extent.height == framebuffer.extent.height;
                                         });
        if (!is_used)
            continue;
        for (const FrameResource resource : family.attachments)
            if (resource == FrameResource::color || resource == FrameResource::exposure)
                framebuffer.turning = resource;
        for (uint32_t number = 0; number < countImages(framebuffer.turning); ++number)
        {
            HEARTH_ASSIGN_OR_RETURN(UniqueFramebuffer handle, createFramebuffer(device, family, number));
            framebuffer.handles.push_back(std::move(handle));
        }
    }
    return success();
}

/// number  of the images that take turns as an attachment
Result<UniqueFramebuffer> FrameTargets::createFramebuffer(const Device& device, const PassFamily& family,
                                                          uint32_t number) const
{
    std::vector<VkImageView> views;
    for (const FrameResource resource : family.attachments)
        views.push_back(attachmentImage(resource, countImages(resource) > 1 ? number : 0).view.get());
    const VkExtent2D extent = attachmentImage(family.attachments.front()).extent;
    VkFramebufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
    info.renderPass = family.any_pass;
    info.attachmentCount = static_cast<uint32_t>(views.size());
    info.pAttachments = views.data();
    info.width = extent.width;
    info.height = extent.height;
    info.layers = 1;
    VkFramebuffer handle;
    HEARTH_TRY_VK(device.vk.vkCreateFramebuffer(device.handle, &info, device.allocator, &handle),
                  "create a framebuffer");
    return UniqueFramebuffer(device, handle);
}

void FrameTargets::beginFrame(const shared::FrameView& view)
{
    current_ = (current_ + 1) % kMaxFramesInFlight;
    const shared::OcclusionView views[] = {pyramid_view_, shared::makeOcclusionView(view)};
    std::memcpy(occlusion_[current_].views.mapped, views, sizeof(views));
}

Status FrameTargets::createPyramids(const Device& device)
{
    const auto [width, height] = extent_;
    const uint64_t texels = shared::pyramidOffset(width, height, shared::pyramidLevels(width, height) + 1);
    if (texels * sizeof(float) > device.limits.maxStorageBufferRange)
        return Error{Issue::device_limit, "", "",
                     "the device cannot bind the depth pyramid of " + std::to_string(width) + "x" +
                         std::to_string(height) + " pixels"};
    constexpr VkBufferUsageFlags kUsage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                          VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    for (uint32_t number = 0; number < pyramidCount(); ++number)
    {
        HEARTH_ASSIGN_OR_RETURN(pyramids_[number],
                                arena_.createBuffer(texels * sizeof(float), kUsage, MemoryKind::device));
    }
    for (OcclusionViews& occlusion : occlusion_)
    {
        HEARTH_ASSIGN_OR_RETURN(occlusion.views,
                                arena_.createBuffer(2 * sizeof(shared::OcclusionView),
                                                    VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, MemoryKind::upload));
    }
    return success();
}

Status FrameTargets::createTileLists(const Device& device)
{
    constexpr VkBufferUsageFlags kUsage =
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT;
    const uint64_t tiles =
        uint64_t{shared::materialTiles(extent_.width)} * shared::materialTiles(extent_.height);
    const uint64_t words = tiles * shared::kMaterialsPerTile + shared::kFirstTileEntry;
    if (words * sizeof(uint32_t) > device.limits.maxStorageBufferRange)
        return Error{Issue::device_limit, "", "",
                     "the device cannot bind the material tiles of " + std::to_string(extent_.width) + "x" +
                         std::to_string(extent_.height) + " pixels"};
    HEARTH_ASSIGN_OR_RETURN(tile_materials_,
                            arena_.createBuffer(tiles * shared::kMaterialsPerTile * sizeof(uint32_t), kUsage,
                                                MemoryKind::device));
    HEARTH_ASSIGN_OR_RETURN(tile_lists_,
                            arena_.createBuffer(words * sizeof(uint32_t), kUsage, MemoryKind::device));
    return success();
}

/// Create the sets of what shading reads: one for all paths but those that add or mark lights ahead of it.
Status FrameTargets::createAttachmentSets(const Device& device, const DrawLayouts& layouts)
{
    const bool is_input = layouts.descriptors.visibility == VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT;
    if (layouts.descriptors.has_light_images)
    {
        HEARTH_ASSIGN_OR_RETURN(no_light_image_,
                                arena_.createImage({.format = kLightBitsFormat,
                                                    .extent = {1, 1},
                                                    .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                                             VK_IMAGE_USAGE_INPUT_ATTACHMENT_BIT}));
    }
    for (size_t i = 0; i < kLightPathCount; ++i)
    {
        const auto path = static_cast<LightPath>(i);
        const bool has_images = path == LightPath::light_bits || sumsLights(path);
        if (path != LightPath::materials && !(has_images && options_.has(path)))
            continue;
        VkDescriptorSet& set = sets_[i].set;
        HEARTH_ASSIGN_OR_RETURN(set, allocateSet(device, pool_.get(), layouts.attachments.get()));
        DescriptorWriter attachments(set);
        if (is_input)
            attachments.input(shared::kAttachmentVisibility, visibility_.view.get());
        else
            attachments.texture(shared::kAttachmentVisibility, visibility_.view.get(), texel_sampler_.get());
        attachments.storage(shared::kAttachmentTileLists, tile_lists_)
            .texture(shared::kAttachmentGi, (gather_ ? gather_->texels() : no_light_).view.get(),
                     texel_sampler_.get());
        const size_t first = path == LightPath::light_bits ? 3 : 0;
        for (uint32_t image = 0; image < shared::kLightImages && layouts.descriptors.has_light_images;
             ++image)
        {
            const bool is_there = has_images && first + image < light_images_.size() &&
                                  light_images_[first + image].view.get() != VK_NULL_HANDLE;
            attachments.input(shared::kAttachmentLight + image,
                              (is_there ? light_images_[first + image] : no_light_image_).view.get());
        }
        attachments.write(device);
    }
    return success();
}

Status FrameTargets::createSets(const Device& device, const DrawLayouts& layouts)
{
    HEARTH_ASSIGN_OR_RETURN(texel_sampler_, createClampingSampler(device, VK_FILTER_NEAREST));
    if (options_.gathers_light)
    {
        HEARTH_ASSIGN_OR_RETURN(gather_, GatherTargets::create(device, layouts, arena_, extent_,
                                                               visibility_.view.get(), texel_sampler_.get()));
    }
    const uint32_t occlusion_sets = kMaxFramesInFlight * pyramidCount();
    constexpr auto kPaths = static_cast<uint32_t>(kLightPathCount);
    const DescriptorPoolSizes sizes{.uniforms = occlusion_sets,
                                    .storages = 2 + kPaths + occlusion_sets,
                                    .textures = 2 + 2 * kPaths + occlusion_sets,
                                    .inputs = kPaths * (1 + shared::kLightImages)};
    HEARTH_ASSIGN_OR_RETURN(pool_, createDescriptorPool(device, 2 + kPaths + occlusion_sets, sizes));
    if (!gather_)
    {
        HEARTH_ASSIGN_OR_RETURN(no_light_, createTexel(arena_, GatherTargets::kFormat));
    }
    HEARTH_TRY(createAttachmentSets(device, layouts));
    if (!depth_leaves_tile_)
    {
        HEARTH_ASSIGN_OR_RETURN(no_depth_, createTexel(arena_, VK_FORMAT_R32_SFLOAT));
    }
    for (OcclusionViews& occlusion : occlusion_)
        for (uint32_t number = 0; number < pyramidCount(); ++number)
        {
            VkDescriptorSet& set = occlusion.sets[number];
            HEARTH_ASSIGN_OR_RETURN(set, allocateSet(device, pool_.get(), layouts.occlusion.get()));
            DescriptorWriter(set)
                .uniform(shared::kOcclusionViews, occlusion.views)
                .storage(shared::kOcclusionPyramid, pyramids_[number])
                .texture(shared::kOcclusionDepth,
                         depth_leaves_tile_ ? sampled_depth_.get() : no_depth_.view.get(),
                         texel_sampler_.get())
                .write(device);
        }
    if (options_.may_split || options_.keeps_visibility)
    {
        HEARTH_ASSIGN_OR_RETURN(pixel_set_, allocateSet(device, pool_.get(), layouts.pixels.get()));
        DescriptorWriter(pixel_set_)
            .texture(shared::kPixelsVisibility, visibility_.view.get(), texel_sampler_.get())
            .write(device);
    }
    if (!options_.may_split)
        return success();
    HEARTH_ASSIGN_OR_RETURN(tile_set_, allocateSet(device, pool_.get(), layouts.tiles.get()));
    DescriptorWriter(tile_set_)
        .texture(shared::kTilesVisibility, visibility_.view.get(), texel_sampler_.get())
        .storage(shared::kTilesMaterials, tile_materials_)
        .storage(shared::kTilesLists, tile_lists_)
        .write(device);
    return success();
}

} // namespace hearth::gpu
