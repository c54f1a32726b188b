// Initial content of the depth pyramid. The frame must not depend on it; tests and tools vary it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/viewer/vulkan_host.h"

namespace hearth::viewer
{

/// Fill the pyramid of the targets with random depths from 0 up to a random limit, as if seen from `view`,
/// which has the size of the targets. Deterministic for a seed. errors: device_failed.
Status writeNoise(VulkanHost& host, const gpu::Device& device, gpu::FrameTargets& targets,
                  const shared::OcclusionView& view, uint32_t seed);

} // namespace hearth::viewer
