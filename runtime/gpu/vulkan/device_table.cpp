// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/vulkan/device_table.h"

namespace hearth::gpu
{

const char* DeviceTable::load(PFN_vkGetInstanceProcAddr get_instance_proc_addr, VkInstance instance,
                              VkDevice device)
{
#define HEARTH_LOAD(name)                                                                                    \
    name = reinterpret_cast<PFN_##name>(get_instance_proc_addr(instance, #name));                            \
    if (name == nullptr)                                                                                     \
        return #name;
    HEARTH_INSTANCE_FUNCTIONS(HEARTH_LOAD)
#undef HEARTH_LOAD
#define HEARTH_LOAD(name)                                                                                    \
    name = reinterpret_cast<PFN_##name>(vkGetDeviceProcAddr(device, #name));                                 \
    if (name == nullptr)                                                                                     \
        return #name;
    HEARTH_DEVICE_FUNCTIONS(HEARTH_LOAD)
#undef HEARTH_LOAD
    return nullptr;
}

const char* DeviceTable::loadDebugLabels(PFN_vkGetInstanceProcAddr get_instance_proc_addr,
                                         VkInstance instance)
{
#define HEARTH_LOAD(name)                                                                                    \
    name = reinterpret_cast<PFN_##name>(get_instance_proc_addr(instance, #name));                            \
    if (name == nullptr)                                                                                     \
        return #name;
    HEARTH_LOAD(vkCmdBeginDebugUtilsLabelEXT)
    HEARTH_LOAD(vkCmdEndDebugUtilsLabelEXT)
#undef HEARTH_LOAD
    return nullptr;
}

} // namespace hearth::gpu
