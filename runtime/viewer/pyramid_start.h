// What the depth pyramid holds when a frame begins. The picture must not depend on it; tests and tools try.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/viewer/vulkan_host.h"

namespace hearth::viewer
{

/// Fill the pyramid of the targets with random depths from 0 up to one that is random as well, said to be seen from
/// `view`, which has the targets' size. The same for the same seed everywhere. errors: device_failed.
Status writeNoise(VulkanHost& host, const gpu::Device& device, gpu::FrameTargets& targets,
                  const shared::OcclusionView& view, uint32_t seed);

} // namespace hearth::viewer
