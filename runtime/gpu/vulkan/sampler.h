// Samplers of tables and of cube maps.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/vulkan/memory.h"

namespace hearth::gpu
{

/// Create a sampler of one mip that clamps coordinates to the edge.
/// errors: device_failed.
Result<UniqueSampler> createClampingSampler(const Device& device, VkFilter filter);

/// Create a trilinear sampler of a cube map, all mips of it.
/// errors: device_failed.
Result<UniqueSampler> createCubeSampler(const Device& device);

} // namespace hearth::gpu
