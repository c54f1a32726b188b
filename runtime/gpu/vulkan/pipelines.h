// Descriptor set layouts, pipelines and descriptor writes, reduced to the options that this renderer varies.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/vulkan/memory.h"

#include <initializer_list>
#include <span>
#include <vector>

namespace hearth::gpu
{

/// Binding of one descriptor.
struct SetBinding
{
    uint32_t binding;
    VkDescriptorType type;
    VkShaderStageFlags stages;
};
constexpr SetBinding uniformBinding(uint32_t binding, VkShaderStageFlags stages)
{
    return {binding, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, stages};
}
constexpr SetBinding storageBinding(uint32_t binding, VkShaderStageFlags stages)
{
    return {binding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, stages};
}
constexpr SetBinding textureBinding(uint32_t binding, VkShaderStageFlags stages)
{
    return {binding, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, stages};
}

Result<UniqueSetLayout> createSetLayout(const Device& device, std::span<const SetBinding> bindings);

/// Layout of the set with a number.
struct NumberedSet
{
    uint32_t number;
    VkDescriptorSetLayout layout;
};

/// Create a layout with sets 0, 1, 2 ..., in any order.
Result<UniquePipelineLayout> createPipelineLayout(const Device& device, std::span<const NumberedSet> sets,
                                                  VkShaderStageFlags push_stages, uint32_t push_bytes);

struct ComputePipeline
{
    UniqueSetLayout set_layout; ///< of a set that no other pipeline has; empty if there is none
    UniquePipelineLayout layout;
    UniquePipeline pipeline;
};
/// constants  value of specialization constant i
Result<ComputePipeline> createComputePipeline(const Device& device, std::span<const uint32_t> spirv,
                                              std::span<const NumberedSet> sets, uint32_t push_bytes = 0,
                                              std::span<const uint32_t> constants = {});

/// Use of the stencil by a pipeline.
enum class Stencil : uint8_t
{
    none,
    mark, ///< sets the bits of the dynamic write mask
    test, ///< draws where the stencil is the dynamic reference
    zero, ///< sets it to 0
    /// Counts back faces less front faces behind the depth: not 0 at depths in a closed solid around which
    /// no two faces of a kind overlap, wherever the eye is.
    enclose,
    take, ///< draws where it is not 0, and sets it to 0
};

/// Colour targets that every device has.
inline constexpr uint32_t kMaxColors = 4;

struct GraphicsDescription
{
    std::span<const uint32_t> vertex;
    std::span<const uint32_t> fragment; ///< empty: depth and stencil alone
    VkPipelineLayout layout;
    bool one_set = false; ///< the layout has all descriptors in its set 0, whichever sets the shaders name
    VkRenderPass render_pass;
    uint32_t subpass;
    VkCullModeFlags cull = VK_CULL_MODE_NONE;
    VkFrontFace front_face = VK_FRONT_FACE_COUNTER_CLOCKWISE;
    VkCompareOp depth_compare;
    bool depth_write;
    uint32_t colors; ///< colour targets of the subpass: 0 to kMaxColors
    bool color_write = true;
    bool add = false; ///< blend additively into all of them
    Stencil stencil = Stencil::none;
    VkPrimitiveTopology topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    std::span<const uint32_t> constants{}; ///< value of specialization constant i, for both stages
};
/// Create a graphics pipeline without vertex buffers; dynamic viewport and scissor.
Result<UniquePipeline> createGraphicsPipeline(const Device& device, const GraphicsDescription& description);

/// Layout of a depth that is read while its stencil is written.
inline constexpr VkImageLayout kReadOnlyDepth = VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_STENCIL_ATTACHMENT_OPTIMAL;

/// Collects writes to one descriptor set.
class DescriptorWriter
{
public:
    explicit DescriptorWriter(VkDescriptorSet set) : set_(set) {}
    DescriptorWriter& uniform(uint32_t binding, const Buffer& buffer, VkDeviceSize offset = 0,
                              VkDeviceSize range = VK_WHOLE_SIZE);
    DescriptorWriter& storage(uint32_t binding, const Buffer& buffer);
    DescriptorWriter& texture(uint32_t binding, VkImageView view, VkSampler sampler);
    DescriptorWriter& input(uint32_t binding, VkImageView view,
                            VkImageLayout layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
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

/// Collects copies from one descriptor set to another.
class DescriptorCopier
{
public:
    /// Copy the descriptors of these bindings, which both sets have.
    DescriptorCopier& copy(VkDescriptorSet from, VkDescriptorSet to, std::span<const SetBinding> bindings);
    void write(const Device& device) const;

private:
    std::vector<VkCopyDescriptorSet> copies_;
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
