// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/window/window_table.h"

namespace hearth::viewer
{

Result<WindowTable> loadWindowTable(const gpu::DeviceDescription& device)
{
    WindowTable table;
    const auto missing = [](const char* name) {
        return Error{Issue::device, "", "", std::string("the driver has no entry point ") + name};
    };
#define HEARTH_LOAD(name)                                                                                    \
    table.name = reinterpret_cast<PFN_##name>(device.get_instance_proc_addr(device.instance, #name));        \
    if (table.name == nullptr)                                                                               \
        return missing(#name);
    HEARTH_WINDOW_INSTANCE_FUNCTIONS(HEARTH_LOAD)
#undef HEARTH_LOAD
    const auto load = reinterpret_cast<PFN_vkGetDeviceProcAddr>(
        device.get_instance_proc_addr(device.instance, "vkGetDeviceProcAddr"));
#define HEARTH_LOAD(name)                                                                                    \
    table.name = reinterpret_cast<PFN_##name>(load(device.device, #name));                                   \
    if (table.name == nullptr)                                                                               \
        return missing(#name);
    HEARTH_WINDOW_DEVICE_FUNCTIONS(HEARTH_LOAD)
#undef HEARTH_LOAD
    return table;
}

} // namespace hearth::viewer
