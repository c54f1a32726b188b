// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/passes/frame_passes.h"

#include "formats/gpu_shared/bindings.h"

#include <array>

namespace hearth::gpu
{

namespace
{

using Attachments = std::array<VkAttachmentDescription, kAttachmentCount>;

VkAttachmentDescription attachment(FrameAttachment which, VkAttachmentLoadOp load, VkAttachmentStoreOp store,
                                   VkImageLayout final_layout)
{
    VkAttachmentDescription description{};
    description.format = kAttachmentFormats[which];
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

// The last frame may still draw to the same images or copy from them. A compute shader builds the pyramid
// from the depth buffer of the early phase.
constexpr VkPipelineStageFlags kStagesOfLastFrame = VK_PIPELINE_STAGE_TRANSFER_BIT |
                                                    VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT |
                                                    kDepthStages | VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
constexpr VkAccessFlags kWritesOfLastFrame =
    VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;

constexpr VkSubpassDependency kDependencies[] = {
    {VK_SUBPASS_EXTERNAL, kSubpassVisibility, kStagesOfLastFrame,
     VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT | kDepthStages, kWritesOfLastFrame,
     VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT | kDepthAccess, 0},
    {VK_SUBPASS_EXTERNAL, kSubpassMaterialDepth, kStagesOfLastFrame, kDepthStages, kWritesOfLastFrame,
     kDepthAccess, 0},
    {VK_SUBPASS_EXTERNAL, kSubpassShading, kStagesOfLastFrame, VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
     kWritesOfLastFrame, VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT, 0},
    {kSubpassVisibility, kSubpassMaterialDepth, VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
     VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
     VK_ACCESS_INPUT_ATTACHMENT_READ_BIT, VK_DEPENDENCY_BY_REGION_BIT},
    {kSubpassVisibility, kSubpassShading, VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
     VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
     VK_ACCESS_INPUT_ATTACHMENT_READ_BIT, VK_DEPENDENCY_BY_REGION_BIT},
    {kSubpassMaterialDepth, kSubpassShading, kDepthStages, kDepthStages,
     VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT, VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT,
     VK_DEPENDENCY_BY_REGION_BIT},
    {kSubpassVisibility, VK_SUBPASS_EXTERNAL, kDepthStages, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
     VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT, VK_ACCESS_SHADER_READ_BIT, 0},
    {kSubpassShading, VK_SUBPASS_EXTERNAL,
     VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT | VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT,
     VK_PIPELINE_STAGE_TRANSFER_BIT | VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
     VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT, VK_ACCESS_TRANSFER_READ_BIT | VK_ACCESS_SHADER_READ_BIT, 0},
};

/// Create a render pass. All phases have the same subpasses and dependencies, so they share framebuffers and
/// pipelines.
Result<UniqueRenderPass> createRenderPass(const Device& device, const Attachments& attachments)
{
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
    static_assert(shared::kInputVisibility == 0);
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
    info.pAttachments = attachments.data();
    info.subpassCount = 3;
    info.pSubpasses = subpasses;
    info.dependencyCount = static_cast<uint32_t>(std::size(kDependencies));
    info.pDependencies = kDependencies;
    VkRenderPass pass;
    HEARTH_TRY_VK(device.vk.vkCreateRenderPass(device.handle, &info, device.allocator, &pass),
                  "create a render pass");
    return UniqueRenderPass(device, pass);
}

/// Return the same attachments without the colour output.
Attachments endAtVisibility(Attachments attachments)
{
    attachments[kVisibility].finalLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    attachments[kColor].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    return attachments;
}

} // namespace

Result<FramePasses> FramePasses::create(const Device& device)
{
    // every pixel of the material depth and of the colour is written, so there is nothing to load or clear
    const Attachments whole = {
        attachment(kVisibility, VK_ATTACHMENT_LOAD_OP_CLEAR, VK_ATTACHMENT_STORE_OP_STORE,
                   VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL),
        attachment(kDepth, VK_ATTACHMENT_LOAD_OP_CLEAR, VK_ATTACHMENT_STORE_OP_DONT_CARE,
                   VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL),
        attachment(kMaterialDepth, VK_ATTACHMENT_LOAD_OP_DONT_CARE, VK_ATTACHMENT_STORE_OP_DONT_CARE,
                   VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL),
        attachment(kColor, VK_ATTACHMENT_LOAD_OP_DONT_CARE, VK_ATTACHMENT_STORE_OP_STORE,
                   VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL)};

    Attachments early = whole;
    early[kVisibility].finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    early[kDepth].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    early[kDepth].finalLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    early[kColor].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;

    Attachments late = whole;
    for (const FrameAttachment kept : {kVisibility, kDepth})
    {
        late[kept].loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
        late[kept].initialLayout = early[kept].finalLayout;
    }

    Attachments shading = whole;
    shading[kVisibility].loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
    shading[kVisibility].initialLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    shading[kDepth].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;

    FramePasses passes;
    HEARTH_ASSIGN_OR_RETURN(passes.whole, createRenderPass(device, whole));
    HEARTH_ASSIGN_OR_RETURN(passes.early, createRenderPass(device, early));
    HEARTH_ASSIGN_OR_RETURN(passes.late, createRenderPass(device, late));
    HEARTH_ASSIGN_OR_RETURN(passes.whole_visibility, createRenderPass(device, endAtVisibility(whole)));
    HEARTH_ASSIGN_OR_RETURN(passes.late_visibility, createRenderPass(device, endAtVisibility(late)));
    HEARTH_ASSIGN_OR_RETURN(passes.shading, createRenderPass(device, shading));
    return passes;
}

} // namespace hearth::gpu
