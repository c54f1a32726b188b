// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/frame/frame_passes.h"

#include "formats/gpu_shared/bindings.h"
#include "runtime/gpu/frame/frame_plan.h"

#include <array>

namespace hearth::gpu
{

namespace
{

FrameAttachment attachmentNumber(FrameResource resource)
{
    switch (resource)
    {
    case FrameResource::visibility:
        return kVisibility;
    case FrameResource::depth:
        return kDepth;
    default:
        HEARTH_ASSERT(resource == FrameResource::color);
        return kColor;
    }
}

VkAttachmentLoadOp toVulkan(LoadOperation load)
{
    switch (load)
    {
    case LoadOperation::clear:
        return VK_ATTACHMENT_LOAD_OP_CLEAR;
    case LoadOperation::load:
        return VK_ATTACHMENT_LOAD_OP_LOAD;
    case LoadOperation::none:
        break;
    }
    return VK_ATTACHMENT_LOAD_OP_DONT_CARE;
}

std::array<VkAttachmentDescription, kAttachmentCount> makeAttachments(const Pass& pass,
                                                                      MaterialTest materials)
{
    HEARTH_ASSERT(pass.attachments.size() == kAttachmentCount);
    std::array<VkAttachmentDescription, kAttachmentCount> attachments{};
    for (const AttachmentUse& use : pass.attachments)
    {
        const FrameAttachment number = attachmentNumber(use.resource);
        VkAttachmentDescription& attachment = attachments[number];
        attachment.format = number == kVisibility ? kVisibilityFormat
                            : number == kDepth    ? depthFormat(materials)
                                                  : kColorFormat;
        attachment.samples = VK_SAMPLE_COUNT_1_BIT;
        attachment.loadOp = toVulkan(use.load);
        attachment.storeOp = use.store ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_DONT_CARE;
        attachment.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        attachment.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        // shading marks materials in a stencil that nothing before has written
        if (number == kDepth && materials == MaterialTest::id)
            attachment.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        attachment.initialLayout = use.initial_layout;
        attachment.finalLayout = use.final_layout;
    }
    return attachments;
}

/// Attachment references of a subpass.
struct SubpassReferences
{
    std::vector<VkAttachmentReference> colors, inputs;
    VkAttachmentReference depth{VK_ATTACHMENT_UNUSED, VK_IMAGE_LAYOUT_UNDEFINED};
};

SubpassReferences makeReferences(const Subpass& subpass)
{
    SubpassReferences references;
    for (const ResourceUse& use : subpass.attachments)
    {
        const VkAttachmentReference reference{attachmentNumber(use.resource), accessLayout(use.access)};
        if (use.access == Access::color_write)
            references.colors.push_back(reference);
        else if (use.access == Access::input)
            references.inputs.push_back(reference);
        else
            references.depth = reference;
    }
    return references;
}

/// Stages and accesses of a subpass's attachments.
PassBarrier attachmentScope(const Subpass& subpass)
{
    PassBarrier scope;
    for (const ResourceUse& use : subpass.attachments)
    {
        scope.to |= accessStages(use.access);
        scope.accessed |= accessFlags(use.access);
        if (isWrite(use.access))
            scope.written |= accessFlags(use.access);
    }
    return scope;
}

/// Return the dependency of a subpass on an earlier one, pixel by pixel.
VkSubpassDependency makeDependency(const Pass& pass, uint32_t from, uint32_t to)
{
    const PassBarrier before = attachmentScope(pass.subpasses[from]);
    const PassBarrier after = attachmentScope(pass.subpasses[to]);
    return {from,
            to,
            before.to,
            after.to,
            before.written,
            after.accessed,
            pass.by_region ? VkDependencyFlags{VK_DEPENDENCY_BY_REGION_BIT} : 0};
}

/// The dependencies on what lies before and after only order the changes of layouts: barriers outside of the
/// pass wait for the content. Copies of the caller need none.
std::vector<VkSubpassDependency> makeDependencies(const Pass& pass)
{
    std::vector<VkSubpassDependency> dependencies;
    for (uint32_t number = 0; number < pass.subpasses.size(); ++number)
    {
        const PassBarrier scope = attachmentScope(pass.subpasses[number]);
        dependencies.push_back({VK_SUBPASS_EXTERNAL, number, scope.to, scope.to, scope.written,
                                scope.accessed, VkDependencyFlags{0}});
        dependencies.push_back({number, VK_SUBPASS_EXTERNAL, scope.to,
                                scope.to | VK_PIPELINE_STAGE_TRANSFER_BIT, scope.written,
                                VK_ACCESS_TRANSFER_READ_BIT, VkDependencyFlags{0}});
        for (uint32_t earlier = 0; earlier < number; ++earlier)
            dependencies.push_back(makeDependency(pass, earlier, number));
    }
    return dependencies;
}

Result<UniqueRenderPass> createRenderPass(const Device& device, const Pass& pass, MaterialTest materials)
{
    HEARTH_ASSERT(pass.subpasses.size() == kSubpassCount);
    static_assert(shared::kInputVisibility == 0);
    const auto attachments = makeAttachments(pass, materials);
    SubpassReferences references[kSubpassCount];
    VkSubpassDescription subpasses[kSubpassCount] = {};
    for (uint32_t i = 0; i < kSubpassCount; ++i)
    {
        references[i] = makeReferences(pass.subpasses[i]);
        subpasses[i].inputAttachmentCount = static_cast<uint32_t>(references[i].inputs.size());
        subpasses[i].pInputAttachments = references[i].inputs.data();
        subpasses[i].colorAttachmentCount = static_cast<uint32_t>(references[i].colors.size());
        subpasses[i].pColorAttachments = references[i].colors.data();
        subpasses[i].pDepthStencilAttachment = &references[i].depth;
    }
    const std::vector<VkSubpassDependency> dependencies = makeDependencies(pass);

    VkRenderPassCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = kAttachmentCount;
    info.pAttachments = attachments.data();
    info.subpassCount = kSubpassCount;
    info.pSubpasses = subpasses;
    info.dependencyCount = static_cast<uint32_t>(dependencies.size());
    info.pDependencies = dependencies.data();
    VkRenderPass handle;
    HEARTH_TRY_VK(device.vk.vkCreateRenderPass(device.handle, &info, device.allocator, &handle),
                  "create a render pass");
    return UniqueRenderPass(device, handle);
}

} // namespace

Result<VkRenderPass> FramePasses::findOrCreate(const Device& device, const Pass& pass)
{
    Key key;
    for (const AttachmentUse& use : pass.attachments)
        key.insert(key.end(),
                   {static_cast<uint32_t>(use.resource), static_cast<uint32_t>(use.load), use.store ? 1u : 0u,
                    static_cast<uint32_t>(use.initial_layout), static_cast<uint32_t>(use.final_layout)});
    const auto found = passes_.find(key);
    if (found != passes_.end())
        return found->second.get();
    HEARTH_ASSIGN_OR_RETURN(UniqueRenderPass created, createRenderPass(device, pass, materials_));
    return passes_.emplace(std::move(key), std::move(created)).first->second.get();
}

Result<FramePasses> FramePasses::create(const Device& device, MaterialTest materials)
{
    FramePasses passes;
    passes.materials_ = materials;
    for (const FrameConfiguration& configuration : allConfigurations(materials))
    {
        FramePlan plan{describeFrame(configuration), {}};
        for (const Pass& pass : plan.description.passes)
        {
            VkRenderPass handle = VK_NULL_HANDLE;
            if (pass.kind == PassKind::render)
            {
                HEARTH_ASSIGN_OR_RETURN(handle, passes.findOrCreate(device, pass));
            }
            plan.render_passes.push_back(handle);
        }
        HEARTH_ASSERT(configurationIndex(configuration) == passes.plans_.size());
        passes.plans_.push_back(std::move(plan));
    }
    return passes;
}

const FramePlan& FramePasses::plan(const FrameConfiguration& configuration) const
{
    return plans_[configurationIndex(configuration)];
}

} // namespace hearth::gpu
