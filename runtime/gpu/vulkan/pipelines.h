// Descriptor set layouts, pipelines and descriptor writes, reduced to the options that this renderer varies.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/vulkan/memory.h"

#include <initializer_list>
#include <span>
#include <vector>

namespace hearth::gpu
{

struct SetBinding
{
    VkDescriptorType type;
    VkShaderStageFlags stages;
};

/// Create a layout with bindings 0, 1, 2 ... of one descriptor each.
Result<UniqueSetLayout> createSetLayout(const Device& device, std::span<const SetBinding> bindings);

Result<UniquePipelineLayout> createPipelineLayout(const Device& device,
                                                  std::span<const VkDescriptorSetLayout> sets,
                                                  VkShaderStageFlags push_stages, uint32_t push_bytes);

/// Compute shader with a descriptor set of its own: binding i has types[i]. Set 1 is shared by pipelines.
struct ComputePipeline
{
    UniqueSetLayout set_layout;
    UniquePipelineLayout layout;
    UniquePipeline pipeline;
};
Result<ComputePipeline> createComputePipeline(const Device& device, std::span<const uint32_t> spirv,
                                              std::initializer_list<VkDescriptorType> types,
                                              uint32_t push_bytes,
                                              VkDescriptorSetLayout shared_set = VK_NULL_HANDLE);
/// Create a pipeline with a shared set 0 only; `set_layout` stays empty.
/// constants  value of specialization constant i
Result<ComputePipeline> createComputePipeline(const Device& device, std::span<const uint32_t> spirv,
                                              uint32_t push_bytes, VkDescriptorSetLayout shared_set,
                                              std::span<const uint32_t> constants = {});

/// Create a pipeline with shared sets only: sets[i] is its set i.
Result<ComputePipeline> createComputePipeline(const Device& device, std::span<const uint32_t> spirv,
                                              std::span<const VkDescriptorSetLayout> sets,
                                              std::span<const uint32_t> constants = {});

struct GraphicsDescription
{
    std::span<const uint32_t> vertex;
    std::span<const uint32_t> fragment;
    VkPipelineLayout layout;
    VkRenderPass render_pass;
    uint32_t subpass;
    VkCullModeFlags cull = VK_CULL_MODE_NONE;
    VkFrontFace front_face = VK_FRONT_FACE_COUNTER_CLOCKWISE;
    VkCompareOp depth_compare;
    bool depth_write;
    bool color;
    bool add = false;                      ///< blend additively into the colour target
    std::span<const uint32_t> constants{}; ///< value of specialization constant i, for both stages
};
/// Create a graphics pipeline: triangles without vertex buffers; dynamic viewport and scissor; at most one
/// colour target.
Result<UniquePipeline> createGraphicsPipeline(const Device& device, const GraphicsDescription& description);

/// Collects writes to one descriptor set.
class DescriptorWriter
{
public:
    explicit DescriptorWriter(VkDescriptorSet set) : set_(set) {}
    DescriptorWriter& uniform(uint32_t binding, const Buffer& buffer, VkDeviceSize offset = 0,
                              VkDeviceSize range = VK_WHOLE_SIZE);
    DescriptorWriter& storage(uint32_t binding, const Buffer& buffer);
    DescriptorWriter& texture(uint32_t binding, VkImageView view, VkSampler sampler);
    DescriptorWriter& input(uint32_t binding, VkImageView view);
    /// Write a storage image in VK_IMAGE_LAYOUT_GENERAL.
    DescriptorWriter& image(uint32_t binding, VkImageView view);
    void write(const Device& device);

private:
    void add(uint32_t binding, VkDescriptorType type, VkDescriptorBufferInfo buffer,
             VkDescriptorImageInfo image);

    struct PendingWrite
    {
        uint32_t binding;
        VkDescriptorType type;
        VkDescriptorBufferInfo buffer;
        VkDescriptorImageInfo image;
    };
    VkDescriptorSet set_;
    std::vector<PendingWrite> entries_;
};

struct DescriptorPoolSizes
{
    uint32_t uniforms = 0;
    uint32_t storages = 0;
    uint32_t textures = 0;
    uint32_t inputs = 0;
    uint32_t images = 0; ///< storage images
};
Result<UniqueDescriptorPool> createDescriptorPool(const Device& device, uint32_t set_count,
                                                  const DescriptorPoolSizes& sizes);

/// Allocate one set of this layout from the pool.
Result<VkDescriptorSet> allocateSet(const Device& device, VkDescriptorPool pool,
                                    VkDescriptorSetLayout layout);

/// Record a global memory barrier.
void barrier(const Device& device, VkCommandBuffer commands, VkPipelineStageFlags from, VkAccessFlags written,
             VkPipelineStageFlags to, VkAccessFlags read);

} // namespace hearth::gpu
