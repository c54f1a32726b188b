// Limits and formats of a device that the renderer needs: one table, checked once at creation.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "runtime/gpu/vulkan/device_table.h"

#include <span>

namespace hearth::gpu
{

struct RequiredLimit
{
    const char* name; ///< of the member of VkPhysicalDeviceLimits; of an array with its index
    uint64_t (*read)(const VkPhysicalDeviceLimits& limits);
    uint64_t needed;
    const char* unit; ///< follows the number, in the plural
    const char* user; ///< what needs it
};

/// Everything that every renderer needs of VkPhysicalDeviceLimits. Needs that follow from a scene, from the
/// size of targets or of shadow maps are checked where those are created.
std::span<const RequiredLimit> requiredLimits();

struct RequiredFormat
{
    VkFormat format;
    VkFormatFeatureFlags features; ///< with optimal tiling
    const char* name;
    const char* user;
};

/// Formats that every renderer needs.
std::span<const RequiredFormat> requiredFormats();

/// Check the limits of a device. errors: device, naming the first limit that is too low.
Status checkLimits(const VkPhysicalDeviceProperties& properties);

/// Check a format of a device. errors: device.
Status checkFormat(const DeviceTable& vk, VkPhysicalDevice physical_device,
                   const VkPhysicalDeviceProperties& properties, const RequiredFormat& required);

} // namespace hearth::gpu
