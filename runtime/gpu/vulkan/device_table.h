// Vulkan entry points that the renderer calls, loaded through the caller's vkGetInstanceProcAddr. Nothing
// links libvulkan, and several devices can exist in one process.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#ifndef VK_NO_PROTOTYPES
#define VK_NO_PROTOTYPES
#endif
#include <vulkan/vulkan_core.h>

#define HEARTH_INSTANCE_FUNCTIONS(X)                                                                         \
    X(vkGetDeviceProcAddr)                                                                                   \
    X(vkGetPhysicalDeviceFormatProperties)                                                                   \
    X(vkGetPhysicalDeviceMemoryProperties)                                                                   \
    X(vkGetPhysicalDeviceProperties)

#define HEARTH_DEVICE_FUNCTIONS(X)                                                                           \
    X(vkAllocateDescriptorSets)                                                                              \
    X(vkAllocateMemory)                                                                                      \
    X(vkBindBufferMemory)                                                                                    \
    X(vkBindImageMemory)                                                                                     \
    X(vkCmdBeginRenderPass)                                                                                  \
    X(vkCmdBindDescriptorSets)                                                                               \
    X(vkCmdBindPipeline)                                                                                     \
    X(vkCmdClearAttachments)                                                                                 \
    X(vkCmdCopyBuffer)                                                                                       \
    X(vkCmdCopyBufferToImage)                                                                                \
    X(vkCmdCopyImage)                                                                                        \
    X(vkCmdDispatch)                                                                                         \
    X(vkCmdDispatchIndirect)                                                                                 \
    X(vkCmdDraw)                                                                                             \
    X(vkCmdDrawIndirect)                                                                                     \
    X(vkCmdEndRenderPass)                                                                                    \
    X(vkCmdFillBuffer)                                                                                       \
    X(vkCmdNextSubpass)                                                                                      \
    X(vkCmdPipelineBarrier)                                                                                  \
    X(vkCmdPushConstants)                                                                                    \
    X(vkCmdResetQueryPool)                                                                                   \
    X(vkCmdSetScissor)                                                                                       \
    X(vkCmdSetStencilReference)                                                                              \
    X(vkCmdSetStencilWriteMask)                                                                              \
    X(vkCmdSetViewport)                                                                                      \
    X(vkCmdUpdateBuffer)                                                                                     \
    X(vkCmdWriteTimestamp)                                                                                   \
    X(vkCreateBuffer)                                                                                        \
    X(vkCreateComputePipelines)                                                                              \
    X(vkCreateDescriptorPool)                                                                                \
    X(vkCreateDescriptorSetLayout)                                                                           \
    X(vkCreateFramebuffer)                                                                                   \
    X(vkCreateGraphicsPipelines)                                                                             \
    X(vkCreateImage)                                                                                         \
    X(vkCreateImageView)                                                                                     \
    X(vkCreatePipelineLayout)                                                                                \
    X(vkCreateRenderPass)                                                                                    \
    X(vkCreateSampler)                                                                                       \
    X(vkCreateShaderModule)                                                                                  \
    X(vkDestroyBuffer)                                                                                       \
    X(vkDestroyDescriptorPool)                                                                               \
    X(vkDestroyDescriptorSetLayout)                                                                          \
    X(vkDestroyFramebuffer)                                                                                  \
    X(vkDestroyImage)                                                                                        \
    X(vkDestroyImageView)                                                                                    \
    X(vkDestroyPipeline)                                                                                     \
    X(vkDestroyPipelineLayout)                                                                               \
    X(vkDestroyRenderPass)                                                                                   \
    X(vkDestroySampler)                                                                                      \
    X(vkDestroyShaderModule)                                                                                 \
    X(vkFreeMemory)                                                                                          \
    X(vkGetBufferMemoryRequirements)                                                                         \
    X(vkGetImageMemoryRequirements)                                                                          \
    X(vkMapMemory)                                                                                           \
    X(vkUpdateDescriptorSets)

namespace hearth::gpu
{

struct DeviceTable
{
#define HEARTH_MEMBER(name) PFN_##name name = nullptr;
    HEARTH_INSTANCE_FUNCTIONS(HEARTH_MEMBER)
    HEARTH_DEVICE_FUNCTIONS(HEARTH_MEMBER)
#undef HEARTH_MEMBER
    PFN_vkCmdBeginDebugUtilsLabelEXT vkCmdBeginDebugUtilsLabelEXT = nullptr; ///< with loadDebugLabels only
    PFN_vkCmdEndDebugUtilsLabelEXT vkCmdEndDebugUtilsLabelEXT = nullptr;

    /// Return nullptr, or the name of the first entry point that is missing.
    const char* load(PFN_vkGetInstanceProcAddr get_instance_proc_addr, VkInstance instance, VkDevice device);
    /// The same for an instance with VK_EXT_debug_utils.
    const char* loadDebugLabels(PFN_vkGetInstanceProcAddr get_instance_proc_addr, VkInstance instance);
};

} // namespace hearth::gpu
