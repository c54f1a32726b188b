// Shows or hides linear filtering of depth formats, whatever the device says.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/vulkan/device.h"

namespace hearth::test
{

/// Return the description with an entry point that says whether depth formats are filtered linearly. The last
/// call counts for all renderers that are made afterwards.
gpu::DeviceDescription sayDepthFiltering(const gpu::DeviceDescription& description, bool filters);

} // namespace hearth::test
