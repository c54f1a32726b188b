// Limits and features of a device, read from a JSON file of profiles/.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <set>
#include <string>
#include <vector>
#include <vulkan/vulkan_core.h>

namespace hearth::test
{

struct LimitValue
{
    std::string name;
    std::vector<uint64_t> values; ///< one, or one for each dimension
};

struct DeviceProfile
{
    std::vector<LimitValue> limits;
    std::set<std::string> features; ///< of VkPhysicalDeviceFeatures; all others are missing
    std::set<VkFormat> missing_formats;
    std::set<VkFormat> unfiltered_formats; ///< not filtered linearly
};

/// Read a profile. Ends the process, with a message, if it cannot be read or names something unknown.
DeviceProfile readProfile(const char* path);

/// Lower the limits of a device to those of a profile; minimum alignments rise.
void clampLimits(const DeviceProfile& profile, VkPhysicalDeviceLimits& limits);

/// Remove the features that a profile lacks.
void clampFeatures(const DeviceProfile& profile, VkPhysicalDeviceFeatures& features);

/// Remove what a profile lacks from the features of a format.
void clampFormat(const DeviceProfile& profile, VkFormat format, VkFormatProperties& properties);

/// Return the name of a feature that the profile lacks and `enabled` has; empty if there is none.
std::string findMissingFeature(const DeviceProfile& profile, const VkPhysicalDeviceFeatures& enabled);

} // namespace hearth::test
