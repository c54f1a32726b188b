// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/vulkan/pipelines.h"

#include "runtime/gpu/vulkan/specialized_shader.h"

#include <algorithm>
#include <iterator>

namespace hearth::gpu
{

namespace
{

Result<UniqueShaderModule> createModule(const Device& device, std::span<const uint32_t> spirv)
{
    const VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, nullptr, 0,
                                        spirv.size_bytes(), spirv.data()};
    VkShaderModule module;
    HEARTH_TRY_VK(device.vk.vkCreateShaderModule(device.handle, &info, device.allocator, &module),
                  "create a shader module");
    return UniqueShaderModule(device, module);
}

/// Specialization constant i has value i.
class ConstantValues
{
public:
    /// The values must outlive this.
    explicit ConstantValues(std::span<const uint32_t> values) : values_(values)
    {
        for (uint32_t i = 0; i < values.size(); ++i)
            entries_.push_back({i, i * uint32_t{sizeof(uint32_t)}, sizeof(uint32_t)});
        info_ = {static_cast<uint32_t>(entries_.size()), entries_.data(), values.size_bytes(), values.data()};
    }
    ConstantValues(const ConstantValues&) = delete;
    ConstantValues& operator=(const ConstantValues&) = delete;

    std::span<const uint32_t> values() const { return values_; }
    const VkSpecializationInfo* info() const { return &info_; }

private:
    std::span<const uint32_t> values_;
    std::vector<VkSpecializationMapEntry> entries_;
    VkSpecializationInfo info_{};
};

void setStencil(Stencil stencil, VkPipelineDepthStencilStateCreateInfo& state)
{
    if (stencil == Stencil::none)
        return;
    state.stencilTestEnable = VK_TRUE;
    VkStencilOpState& front = state.front;
    front = {.failOp = VK_STENCIL_OP_KEEP,
             .passOp = VK_STENCIL_OP_KEEP,
             .depthFailOp = VK_STENCIL_OP_KEEP,
             .compareOp = VK_COMPARE_OP_ALWAYS,
             .compareMask = 0xFF,
             .writeMask = 0xFF,
             .reference = 0};
    switch (stencil)
    {
    case Stencil::mark:
        front.passOp = VK_STENCIL_OP_REPLACE;
        front.reference = 0xFF;
        break;
    case Stencil::test:
        front.compareOp = VK_COMPARE_OP_EQUAL;
        break;
    case Stencil::zero:
        front.passOp = VK_STENCIL_OP_ZERO;
        break;
    case Stencil::take:
        front.compareOp = VK_COMPARE_OP_NOT_EQUAL;
        front.passOp = VK_STENCIL_OP_ZERO;
        break;
    case Stencil::enclose:
        front.depthFailOp = VK_STENCIL_OP_DECREMENT_AND_WRAP;
        break;
    case Stencil::none:
        break;
    }
    state.back = front;
    if (stencil == Stencil::enclose)
        state.back.depthFailOp = VK_STENCIL_OP_INCREMENT_AND_WRAP;
}

/// Shader of a pipeline with its constants, in a module that has the code alone that they leave.
class Stage
{
public:
    /// constants  those of the pipeline, which must outlive the stage
    static Result<Stage> create(const Device& device, VkShaderStageFlagBits stage,
                                std::span<const uint32_t> spirv, const ConstantValues& constants)
    {
        Stage result;
        const std::optional<std::vector<uint32_t>> specialized =
            device.specializes_shaders ? specializeShader(spirv, constants.values()) : std::nullopt;
        HEARTH_ASSIGN_OR_RETURN(result.module_, createModule(device, specialized ? *specialized : spirv));
        result.info_ = {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                        nullptr,
                        0,
                        stage,
                        result.module_.get(),
                        "main",
                        specialized ? nullptr : constants.info()};
        return result;
    }

    const VkPipelineShaderStageCreateInfo& info() const { return info_; }

private:
    UniqueShaderModule module_;
    VkPipelineShaderStageCreateInfo info_{};
};

} // namespace

Result<UniqueSetLayout> createSetLayout(const Device& device, std::span<const SetBinding> bindings)
{
    std::vector<VkDescriptorSetLayoutBinding> infos;
    for (const SetBinding& binding : bindings)
        infos.push_back({binding.binding, binding.type, 1, binding.stages, nullptr});
    const VkDescriptorSetLayoutCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO, nullptr,
                                               0, static_cast<uint32_t>(infos.size()), infos.data()};
    VkDescriptorSetLayout layout;
    HEARTH_TRY_VK(device.vk.vkCreateDescriptorSetLayout(device.handle, &info, device.allocator, &layout),
                  "create a descriptor set layout");
    return UniqueSetLayout(device, layout);
}

Result<UniquePipelineLayout> createPipelineLayout(const Device& device, std::span<const NumberedSet> sets,
                                                  VkShaderStageFlags push_stages, uint32_t push_bytes)
{
    std::vector<VkDescriptorSetLayout> set_layouts(sets.size(), VK_NULL_HANDLE);
    for (const NumberedSet& set : sets)
    {
        HEARTH_ASSERT(set.number < sets.size() && set_layouts[set.number] == VK_NULL_HANDLE);
        set_layouts[set.number] = set.layout;
    }
    const VkPushConstantRange push{push_stages, 0, push_bytes};
    const VkPipelineLayoutCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                          nullptr,
                                          0,
                                          static_cast<uint32_t>(set_layouts.size()),
                                          set_layouts.data(),
                                          push_bytes > 0 ? 1u : 0u,
                                          &push};
    VkPipelineLayout layout;
    HEARTH_TRY_VK(device.vk.vkCreatePipelineLayout(device.handle, &info, device.allocator, &layout),
                  "create a pipeline layout");
    return UniquePipelineLayout(device, layout);
}

Result<ComputePipeline> createComputePipeline(const Device& device, std::span<const uint32_t> spirv,
                                              std::span<const NumberedSet> sets, uint32_t push_bytes,
                                              std::span<const uint32_t> constants)
{
    ComputePipeline result;
    HEARTH_ASSIGN_OR_RETURN(result.layout,
                            createPipelineLayout(device, sets, VK_SHADER_STAGE_COMPUTE_BIT, push_bytes));
    const ConstantValues values(constants);
    HEARTH_ASSIGN_OR_RETURN(const Stage stage,
                            Stage::create(device, VK_SHADER_STAGE_COMPUTE_BIT, spirv, values));

    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.stage = stage.info();
    info.layout = result.layout.get();
    VkPipeline pipeline;
    HEARTH_TRY_VK(device.vk.vkCreateComputePipelines(device.handle, device.pipeline_cache, 1, &info,
                                                     device.allocator, &pipeline),
                  "create a compute pipeline");
    result.pipeline = UniquePipeline(device, pipeline);
    return result;
}

Result<UniquePipeline> createGraphicsPipeline(const Device& device, const GraphicsDescription& description)
{
    const ConstantValues constants(description.constants);
    std::vector<Stage> created;
    std::vector<VkPipelineShaderStageCreateInfo> stages;
    const auto add_stage = [&](VkShaderStageFlagBits stage, std::span<const uint32_t> spirv) -> Status
    {
        const std::vector<uint32_t> moved =
            description.one_set ? moveToOneSet(spirv) : std::vector<uint32_t>{};
        HEARTH_ASSIGN_OR_RETURN(Stage added,
                                Stage::create(device, stage, description.one_set ? moved : spirv, constants));
        stages.push_back(added.info());
        created.push_back(std::move(added));
        return success();
    };
    HEARTH_TRY(add_stage(VK_SHADER_STAGE_VERTEX_BIT, description.vertex));
    if (!description.fragment.empty())
        HEARTH_TRY(add_stage(VK_SHADER_STAGE_FRAGMENT_BIT, description.fragment));
    VkPipelineVertexInputStateCreateInfo vertex_input{};
    vertex_input.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
    VkPipelineInputAssemblyStateCreateInfo assembly{};
    assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
    assembly.topology = description.topology;
    VkPipelineViewportStateCreateInfo viewport{};
    viewport.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
    viewport.viewportCount = 1;
    viewport.scissorCount = 1;
    VkPipelineRasterizationStateCreateInfo raster{};
    raster.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
    raster.polygonMode = VK_POLYGON_MODE_FILL;
    raster.cullMode = description.cull;
    raster.frontFace = description.front_face;
    raster.lineWidth = 1;
    VkPipelineMultisampleStateCreateInfo multisample{};
    multisample.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
    multisample.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    VkPipelineDepthStencilStateCreateInfo depth{};
    depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
    // a test that always passes and writes nothing would still load the depth on some tilers
    const bool uses_depth = description.depth_write || description.depth_compare != VK_COMPARE_OP_ALWAYS;
    depth.depthTestEnable = uses_depth ? VK_TRUE : VK_FALSE;
    depth.depthWriteEnable = description.depth_write ? VK_TRUE : VK_FALSE;
    depth.depthCompareOp = description.depth_compare;
    setStencil(description.stencil, depth);
    VkPipelineColorBlendStateCreateInfo color{};
    color.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
    constexpr VkColorComponentFlags kAllComponents = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                                                     VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
    VkPipelineColorBlendAttachmentState blends[kMaxColors] = {};
    blends[0].blendEnable = description.add ? VK_TRUE : VK_FALSE;
    blends[0].srcColorBlendFactor = blends[0].dstColorBlendFactor = VK_BLEND_FACTOR_ONE;
    blends[0].srcAlphaBlendFactor = blends[0].dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
    blends[0].colorWriteMask = description.color_write ? kAllComponents : 0;
    std::fill(std::begin(blends) + 1, std::end(blends), blends[0]); // differences are a feature of devices
    HEARTH_ASSERT(description.colors <= kMaxColors);
    color.attachmentCount = description.colors;
    color.pAttachments = blends;
    std::vector<VkDynamicState> dynamic_states = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    if (description.stencil == Stencil::mark)
        dynamic_states.push_back(VK_DYNAMIC_STATE_STENCIL_WRITE_MASK);
    if (description.stencil == Stencil::test)
        dynamic_states.push_back(VK_DYNAMIC_STATE_STENCIL_REFERENCE);
    VkPipelineDynamicStateCreateInfo dynamic{};
    dynamic.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
    dynamic.dynamicStateCount = static_cast<uint32_t>(dynamic_states.size());
    dynamic.pDynamicStates = dynamic_states.data();

    VkGraphicsPipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
    info.stageCount = static_cast<uint32_t>(stages.size());
    info.pStages = stages.data();
    info.pVertexInputState = &vertex_input;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &multisample;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &color;
    info.pDynamicState = &dynamic;
    info.layout = description.layout;
    info.renderPass = description.render_pass;
    info.subpass = description.subpass;
    VkPipeline pipeline;
    HEARTH_TRY_VK(device.vk.vkCreateGraphicsPipelines(device.handle, device.pipeline_cache, 1, &info,
                                                      device.allocator, &pipeline),
                  "create a graphics pipeline");
    return UniquePipeline(device, pipeline);
}

void DescriptorWriter::add(uint32_t binding, VkDescriptorType type, VkDescriptorBufferInfo buffer,
                           VkDescriptorImageInfo image)
{
    entries_.push_back({binding, type, buffer, image});
}

DescriptorWriter& DescriptorWriter::uniform(uint32_t binding, const Buffer& buffer, VkDeviceSize offset,
                                            VkDeviceSize range)
{
    add(binding, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, {buffer.handle.get(), offset, range}, {});
    return *this;
}

DescriptorWriter& DescriptorWriter::storage(uint32_t binding, const Buffer& buffer)
{
    add(binding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, {buffer.handle.get(), 0, VK_WHOLE_SIZE}, {});
    return *this;
}

DescriptorWriter& DescriptorWriter::texture(uint32_t binding, VkImageView view, VkSampler sampler)
{
    add(binding, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, {},
        {sampler, view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL});
    return *this;
}

DescriptorWriter& DescriptorWriter::input(uint32_t binding, VkImageView view, VkImageLayout layout)
{
    add(binding, VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT, {}, {VK_NULL_HANDLE, view, layout});
    return *this;
}

DescriptorWriter& DescriptorWriter::image(uint32_t binding, VkImageView view)
{
    add(binding, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, {}, {VK_NULL_HANDLE, view, VK_IMAGE_LAYOUT_GENERAL});
    return *this;
}

void DescriptorWriter::write(const Device& device)
{
    std::vector<VkWriteDescriptorSet> writes;
    for (const PendingWrite& entry : entries_)
    {
        VkWriteDescriptorSet write{};
        write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        write.dstSet = set_;
        write.dstBinding = entry.binding;
        write.descriptorCount = 1;
        write.descriptorType = entry.type;
        write.pBufferInfo = &entry.buffer;
        write.pImageInfo = &entry.image;
        writes.push_back(write);
    }
    device.vk.vkUpdateDescriptorSets(device.handle, static_cast<uint32_t>(writes.size()), writes.data(), 0,
                                     nullptr);
}

DescriptorCopier& DescriptorCopier::copy(VkDescriptorSet from, VkDescriptorSet to,
                                         std::span<const SetBinding> bindings)
{
    for (const SetBinding& binding : bindings)
        copies_.push_back({VK_STRUCTURE_TYPE_COPY_DESCRIPTOR_SET, nullptr, from, binding.binding, 0, to,
                           binding.binding, 0, 1});
    return *this;
}

void DescriptorCopier::write(const Device& device) const
{
    device.vk.vkUpdateDescriptorSets(device.handle, 0, nullptr, static_cast<uint32_t>(copies_.size()),
                                     copies_.data());
}

Result<UniqueDescriptorPool> createDescriptorPool(const Device& device, uint32_t set_count,
                                                  const DescriptorPoolSizes& sizes)
{
    const VkDescriptorPoolSize all[] = {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, sizes.uniforms},
                                        {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, sizes.storages},
                                        {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, sizes.textures},
                                        {VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT, sizes.inputs},
                                        {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, sizes.images}};
    std::vector<VkDescriptorPoolSize> used;
    for (const VkDescriptorPoolSize& size : all)
        if (size.descriptorCount > 0)
            used.push_back(size);
    const VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                          nullptr,
                                          0,
                                          set_count,
                                          static_cast<uint32_t>(used.size()),
                                          used.data()};
    VkDescriptorPool pool;
    HEARTH_TRY_VK(device.vk.vkCreateDescriptorPool(device.handle, &info, device.allocator, &pool),
                  "create a descriptor pool");
    return UniqueDescriptorPool(device, pool);
}

Result<VkDescriptorSet> allocateSet(const Device& device, VkDescriptorPool pool, VkDescriptorSetLayout layout)
{
    const VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO, nullptr, pool, 1,
                                           &layout};
    VkDescriptorSet set;
    HEARTH_TRY_VK(device.vk.vkAllocateDescriptorSets(device.handle, &info, &set),
                  "allocate a descriptor set");
    return set;
}

void barrier(const Device& device, VkCommandBuffer commands, VkPipelineStageFlags from, VkAccessFlags written,
             VkPipelineStageFlags to, VkAccessFlags read)
{
    const VkMemoryBarrier memory{VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, written, read};
    device.vk.vkCmdPipelineBarrier(commands, from, to, 0, 1, &memory, 0, nullptr, 0, nullptr);
}

} // namespace hearth::gpu
