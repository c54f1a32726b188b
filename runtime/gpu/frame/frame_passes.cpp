// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/frame/frame_passes.h"

#include "formats/gpu_shared/bindings.h"

#include <algorithm>

namespace hearth::gpu
{

namespace
{

VkFormat attachmentFormat(const Pass& pass, FrameResource resource, MaterialTest materials)
{
    switch (resource)
    {
    case FrameResource::visibility:
        return kVisibilityFormat;
    case FrameResource::depth:
        return depthFormat(materials);
    case FrameResource::shadow_map:
        return pass.map_format;
    case FrameResource::color:
        return pass.color_format;
    case FrameResource::surfaces:
        return kSurfacesFormat;
    case FrameResource::normals:
    case FrameResource::joint_normals:
    case FrameResource::encoded_normals:
        return normalsFormat(resource);
    case FrameResource::diffuse_light:
    case FrameResource::specular_light:
    case FrameResource::grazing_light:
        return kLightSumFormat;
    case FrameResource::low_light_bits:
    case FrameResource::high_light_bits:
        return kLightBitsFormat;
    case FrameResource::exposure:
        return kExposureFormat;
    default:
        HEARTH_ASSERT(isLinear(resource));
        return pass.radiance_format;
    }
}

/// Return the number of an attachment of the pass.
uint32_t attachmentNumber(const Pass& pass, FrameResource resource)
{
    const auto found = std::find_if(pass.attachments.begin(), pass.attachments.end(),
                                    [&](const AttachmentUse& use) { return use.resource == resource; });
    HEARTH_ASSERT(found != pass.attachments.end());
    return static_cast<uint32_t>(found - pass.attachments.begin());
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

std::vector<VkAttachmentDescription> makeAttachments(const Pass& pass, MaterialTest materials)
{
    std::vector<VkAttachmentDescription> attachments;
    for (const AttachmentUse& use : pass.attachments)
    {
        VkAttachmentDescription attachment{};
        attachment.format = attachmentFormat(pass, use.resource, materials);
        attachment.samples = VK_SAMPLE_COUNT_1_BIT;
        attachment.loadOp = toVulkan(use.load);
        attachment.storeOp = use.store ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_DONT_CARE;
        attachment.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        attachment.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        // shading marks materials in a stencil that nothing before has written
        if (use.resource == FrameResource::depth && materials == MaterialTest::id)
            attachment.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        attachment.initialLayout = use.initial_layout;
        attachment.finalLayout = use.final_layout;
        attachments.push_back(attachment);
    }
    return attachments;
}

/// Attachment references of a subpass.
struct SubpassReferences
{
    std::vector<VkAttachmentReference> colors, inputs;
    VkAttachmentReference depth{VK_ATTACHMENT_UNUSED, VK_IMAGE_LAYOUT_UNDEFINED};
};

SubpassReferences makeReferences(const Pass& pass, const Subpass& subpass)
{
    SubpassReferences references;
    for (const ResourceUse& use : subpass.attachments)
    {
        const VkAttachmentReference reference{attachmentNumber(pass, use.resource), accessLayout(use.access)};
        if (use.access == Access::color_write)
            references.colors.push_back(reference);
        else if (use.access == Access::input)
            references.inputs.push_back(reference);
        else
            references.depth = reference;
        if (use.access == Access::depth_input)
            references.inputs.push_back(reference);
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
    static_assert(shared::kInputVisibility == 0 && shared::kInputDepth == 0 && shared::kInputSurfaces == 1);
    static_assert(shared::kInputLight == 1 && shared::kInputLightSampled == 0);
    const auto attachments = makeAttachments(pass, materials);
    std::vector<SubpassReferences> references(pass.subpasses.size());
    std::vector<VkSubpassDescription> subpasses(pass.subpasses.size());
    for (size_t i = 0; i < subpasses.size(); ++i)
    {
        references[i] = makeReferences(pass, pass.subpasses[i]);
        subpasses[i].inputAttachmentCount = static_cast<uint32_t>(references[i].inputs.size());
        subpasses[i].pInputAttachments = references[i].inputs.data();
        subpasses[i].colorAttachmentCount = static_cast<uint32_t>(references[i].colors.size());
        subpasses[i].pColorAttachments = references[i].colors.data();
        subpasses[i].pDepthStencilAttachment = &references[i].depth;
    }
    const std::vector<VkSubpassDependency> dependencies = makeDependencies(pass);

    VkRenderPassCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = static_cast<uint32_t>(attachments.size());
    info.pAttachments = attachments.data();
    info.subpassCount = static_cast<uint32_t>(subpasses.size());
    info.pSubpasses = subpasses.data();
    info.dependencyCount = static_cast<uint32_t>(dependencies.size());
    info.pDependencies = dependencies.data();
    VkRenderPass handle;
    HEARTH_TRY_VK(device.vk.vkCreateRenderPass(device.handle, &info, device.allocator, &handle),
                  "create a render pass");
    return UniqueRenderPass(device, handle);
}

} // namespace

Result<PlannedPass> FramePasses::findOrCreate(const Device& device, const Pass& pass)
{
    Key key{static_cast<uint32_t>(pass.map_format)};
    std::vector<FrameResource> attachments;
    for (const AttachmentUse& use : pass.attachments)
    {
        key.insert(key.end(),
                   {static_cast<uint32_t>(use.resource), static_cast<uint32_t>(use.load), use.store ? 1u : 0u,
                    static_cast<uint32_t>(use.initial_layout), static_cast<uint32_t>(use.final_layout)});
        attachments.push_back(use.resource);
    }
    if (const auto found = passes_.find(key); found != passes_.end())
        return PlannedPass{found->second.handle.get(), found->second.family};
    CreatedPass created;
    HEARTH_ASSIGN_OR_RETURN(created.handle, createRenderPass(device, pass, options_.materials));
    const VkRenderPass handle = created.handle.get();
    if (hasOwnSize(pass))
    {
        passes_.emplace(std::move(key), std::move(created));
        return PlannedPass{handle, 0};
    }
    std::vector<std::vector<Access>> accesses;
    for (const Subpass& subpass : pass.subpasses)
    {
        accesses.emplace_back();
        for (const ResourceUse& use : subpass.attachments)
            accesses.back().push_back(use.access);
    }
    const auto family = std::find_if(families_.begin(), families_.end(),
                                     [&](const PassFamily& f)
                                     { return f.attachments == attachments && f.accesses == accesses; });
    created.family = static_cast<uint32_t>(family - families_.begin());
    if (family == families_.end())
        families_.push_back({std::move(attachments), std::move(accesses), handle});
    const PlannedPass planned{handle, created.family};
    passes_.emplace(std::move(key), std::move(created));
    return planned;
}

Result<UniqueRenderPass> FramePasses::createLeaving(const Device& device, const Pass& pass,
                                                    VkImageLayout color) const
{
    Pass leaving = pass;
    for (AttachmentUse& use : leaving.attachments)
        if (use.resource == FrameResource::color)
            use.final_layout = color;
    return createRenderPass(device, leaving, options_.materials);
}

Result<FramePasses> FramePasses::create(const Device& device, const FramePassOptions& options)
{
    FramePasses passes;
    passes.options_ = options;
    HEARTH_ASSERT(!options.deferred || options.radiance_format.has_value());
    passes.features_ = options.deferred          ? FrameFeatures::deferred
                       : options.radiance_format ? FrameFeatures::finished
                                                 : FrameFeatures::shaded;
    std::vector<FrameConfiguration> configurations;
    for (FrameConfiguration configuration :
         allConfigurations(options.way, options.materials, passes.features_))
    {
        addLightLists(configuration);
        configuration.keeps_depth = options.keeps_depth;
        configuration.color_format = options.color_format;
        configuration.lights_bricks = true;
        configuration.radiance_format = passes.radianceFormat();
        configurations.push_back(configuration);
        addMapsOfAllKinds(configuration);
        for (const VkFormat format : {VK_FORMAT_D32_SFLOAT, VK_FORMAT_D16_UNORM})
        {
            configuration.shadow_format = format;
            configurations.push_back(configuration);
        }
    }
    for (FrameDescription& description : describeFrames(configurations))
    {
        FramePlan plan{std::move(description), {}};
        for (const Pass& pass : plan.description.passes)
        {
            PlannedPass planned;
            if (pass.kind == PassKind::render)
            {
                HEARTH_ASSIGN_OR_RETURN(planned, passes.findOrCreate(device, pass));
            }
            plan.render_passes.push_back(planned);
        }
        HEARTH_ASSERT(passes.planNumber(plan.description.configuration) == passes.plans_.size());
        passes.plans_.push_back(std::move(plan));
    }
    return passes;
}

size_t FramePasses::planNumber(const FrameConfiguration& configuration)
{
    const size_t shadows = !configuration.has_shadows                            ? 0
                           : configuration.shadow_format == VK_FORMAT_D32_SFLOAT ? 1
                                                                                 : 2;
    return 3 * configurationIndex(configuration) + shadows;
}

const FramePlan& FramePasses::plan(const FrameConfiguration& configuration) const
{
    return plans_[planNumber(configuration)];
}

bool FramePasses::has(ShadedOutput output) const
{
    return output == ShadedOutput::color || (output == ShadedOutput::radiance && hasFinalPasses()) ||
           features_ == FrameFeatures::deferred;
}

DrawPlace FramePasses::place(ShadedOutput output, FrameStep step) const
{
    HEARTH_ASSERT(has(output));
    return findPlace(plan({.has_final_pass = isRadiance(output), .light_path = lightPath(output)}), step);
}

VkRenderPass FramePasses::shadowMapPass(VkFormat format) const
{
    return findPlace(plan({.has_shadows = true, .shadow_format = format}), FrameStep::shadow_map).render_pass;
}

DrawPlace FramePasses::findPlace(const FramePlan& plan, FrameStep step)
{
    for (size_t number = 0; number < plan.render_passes.size(); ++number)
    {
        const std::vector<Subpass>& subpasses = plan.description.passes[number].subpasses;
        for (uint32_t i = 0; i < subpasses.size(); ++i)
            if (subpasses[i].step == step)
                return {plan.render_passes[number].render_pass, i};
    }
    HEARTH_ASSERT(false);
    return {};
}

} // namespace hearth::gpu
