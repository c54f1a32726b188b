// Samplers without mips.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/vulkan/memory.h"

namespace hearth::gpu
{

/// Create a sampler of one mip that clamps coordinates to the edge.
/// errors: device_failed.
Result<UniqueSampler> createClampingSampler(const Device& device, VkFilter filter);

} // namespace hearth::gpu
