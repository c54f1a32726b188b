// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/frame_targets.h"

#include <string>

namespace hearth::gpu
{

namespace
{

enum Attachment : uint32_t
{
    kVisibility,
    kDepth,
    kMaterialDepth,
    kColor,
    kAttachmentCount,
};

constexpr VkFormat kFormats[kAttachmentCount] = {kVisibilityFormat, VK_FORMAT_D32_SFLOAT, VK_FORMAT_D16_UNORM,
                                                 kColorFormat};

VkAttachmentDescription attachment(Attachment which, VkAttachmentLoadOp load, VkAttachmentStoreOp store,
                                   VkImageLayout final_layout)
{
    VkAttachmentDescription description{};
    description.format = kFormats[which];
    description.samples = VK_SAMPLE_COUNT_1_BIT;
    description.loadOp = load;
    description.storeOp = store;
    description.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    description.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    description.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    description.finalLayout = final_layout;
    return description;
}

constexpr VkPipelineStageFlags kDepthStages =
    VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
constexpr VkAccessFlags kDepthAccess =
    VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;

// A frame may follow another that still draws to, or is copied from, the same images.
constexpr VkPipelineStageFlags kFrameBefore =
    VK_PIPELINE_STAGE_TRANSFER_BIT | VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT | kDepthStages;
constexpr VkAccessFlags kWrittenBefore =
    VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;

constexpr VkSubpassDependency kDependencies[] = {
    {VK_SUBPASS_EXTERNAL, kSubpassVisibility, kFrameBefore,
     VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT | kDepthStages, kWrittenBefore,
     VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT | kDepthAccess, 0},
    {VK_SUBPASS_EXTERNAL, kSubpassMaterialDepth, kFrameBefore, kDepthStages, kWrittenBefore, kDepthAccess, 0},
    {VK_SUBPASS_EXTERNAL, kSubpassShading, kFrameBefore, VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
     kWrittenBefore, VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT, 0},
    {kSubpassVisibility, kSubpassMaterialDepth, VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
     VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
     VK_ACCESS_INPUT_ATTACHMENT_READ_BIT, VK_DEPENDENCY_BY_REGION_BIT},
    {kSubpassVisibility, kSubpassShading, VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
     VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
     VK_ACCESS_INPUT_ATTACHMENT_READ_BIT, VK_DEPENDENCY_BY_REGION_BIT},
    {kSubpassMaterialDepth, kSubpassShading, kDepthStages, kDepthStages,
     VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT, VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT,
     VK_DEPENDENCY_BY_REGION_BIT},
    {kSubpassShading, VK_SUBPASS_EXTERNAL,
     VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT | VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT,
     VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT, VK_ACCESS_TRANSFER_READ_BIT, 0},
};

} // namespace

Result<UniqueRenderPass> createFrameRenderPass(const Device& device)
{
    // every pixel of the material depth and of the colour is written: nothing to load or clear
    const VkAttachmentDescription attachments[kAttachmentCount] = {
        attachment(kVisibility, VK_ATTACHMENT_LOAD_OP_CLEAR, VK_ATTACHMENT_STORE_OP_STORE,
                   VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL),
        attachment(kDepth, VK_ATTACHMENT_LOAD_OP_CLEAR, VK_ATTACHMENT_STORE_OP_DONT_CARE,
                   VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL),
        attachment(kMaterialDepth, VK_ATTACHMENT_LOAD_OP_DONT_CARE, VK_ATTACHMENT_STORE_OP_DONT_CARE,
                   VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL),
        attachment(kColor, VK_ATTACHMENT_LOAD_OP_DONT_CARE, VK_ATTACHMENT_STORE_OP_STORE,
                   VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL)};

    const VkAttachmentReference visibility_out{kVisibility, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    const VkAttachmentReference visibility_in{kVisibility, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    const VkAttachmentReference depth{kDepth, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    const VkAttachmentReference material_out{kMaterialDepth,
                                             VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    const VkAttachmentReference material_in{kMaterialDepth, VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL};
    const VkAttachmentReference color{kColor, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};

    VkSubpassDescription subpasses[3] = {};
    subpasses[kSubpassVisibility].colorAttachmentCount = 1;
    subpasses[kSubpassVisibility].pColorAttachments = &visibility_out;
    subpasses[kSubpassVisibility].pDepthStencilAttachment = &depth;
    subpasses[kSubpassMaterialDepth].inputAttachmentCount = 1;
    subpasses[kSubpassMaterialDepth].pInputAttachments = &visibility_in;
    subpasses[kSubpassMaterialDepth].pDepthStencilAttachment = &material_out;
    subpasses[kSubpassShading].inputAttachmentCount = 1;
    subpasses[kSubpassShading].pInputAttachments = &visibility_in;
    subpasses[kSubpassShading].colorAttachmentCount = 1;
    subpasses[kSubpassShading].pColorAttachments = &color;
    subpasses[kSubpassShading].pDepthStencilAttachment = &material_in;

    VkRenderPassCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = kAttachmentCount;
    info.pAttachments = attachments;
    info.subpassCount = 3;
    info.pSubpasses = subpasses;
    info.dependencyCount = static_cast<uint32_t>(std::size(kDependencies));
    info.pDependencies = kDependencies;
    VkRenderPass pass;
    HEARTH_TRY_VK(device.vk.vkCreateRenderPass(device.handle, &info, device.allocator, &pass),
                  "create a render pass");
    return UniqueRenderPass(device, pass);
}

Result<FrameTargets> FrameTargets::create(const Device& device, VkRenderPass render_pass,
                                          const DrawLayouts& layouts, VkExtent2D extent)
{
    if (extent.width > device.limits.maxFramebufferWidth ||
        extent.height > device.limits.maxFramebufferHeight ||
        std::max(extent.width, extent.height) > device.limits.maxImageDimension2D)
        return Error{Issue::device_limit, "", "",
                     "the device cannot render " + std::to_string(extent.width) + "x" +
                         std::to_string(extent.height) + " pixels"};
    constexpr VkImageUsageFlags kColorUsage =
        VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    constexpr VkImageUsageFlags kDepthUsage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    FrameTargets t(device);
    HEARTH_ASSIGN_OR_RETURN(
        t.visibility_, t.arena_.createImage({.format = kFormats[kVisibility],
                                             .extent = extent,
                                             .usage = kColorUsage | VK_IMAGE_USAGE_INPUT_ATTACHMENT_BIT}));
    HEARTH_ASSIGN_OR_RETURN(t.depth_, t.arena_.createImage({.format = kFormats[kDepth],
                                                            .extent = extent,
                                                            .usage = kDepthUsage,
                                                            .aspect = VK_IMAGE_ASPECT_DEPTH_BIT}));
    HEARTH_ASSIGN_OR_RETURN(t.material_depth_, t.arena_.createImage({.format = kFormats[kMaterialDepth],
                                                                     .extent = extent,
                                                                     .usage = kDepthUsage,
                                                                     .aspect = VK_IMAGE_ASPECT_DEPTH_BIT}));
    HEARTH_ASSIGN_OR_RETURN(
        t.color_, t.arena_.createImage({.format = kFormats[kColor], .extent = extent, .usage = kColorUsage}));

    const VkImageView views[kAttachmentCount] = {t.visibility_.view.get(), t.depth_.view.get(),
                                                 t.material_depth_.view.get(), t.color_.view.get()};
    VkFramebufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
    info.renderPass = render_pass;
    info.attachmentCount = kAttachmentCount;
    info.pAttachments = views;
    info.width = extent.width;
    info.height = extent.height;
    info.layers = 1;
    VkFramebuffer framebuffer;
    HEARTH_TRY_VK(device.vk.vkCreateFramebuffer(device.handle, &info, device.allocator, &framebuffer),
                  "create a framebuffer");
    t.framebuffer_ = UniqueFramebuffer(device, framebuffer);

    const DescriptorPoolSizes sizes{.inputs = 1};
    HEARTH_ASSIGN_OR_RETURN(t.pool_, createDescriptorPool(device, 1, sizes));
    HEARTH_ASSIGN_OR_RETURN(t.set_, allocateSet(device, t.pool_.get(), layouts.attachments.get()));
    DescriptorWriter(t.set_).input(0, t.visibility_.view.get()).write(device);
    return t;
}

} // namespace hearth::gpu
