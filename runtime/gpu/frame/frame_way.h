// Choice of the way through a frame by the facts of a device.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/frame/frame_description.h"
#include "runtime/gpu/vulkan/device.h"

namespace hearth::gpu
{

/// Return FrameWay::merged, unless public reports say that the device fails at subpasses or gains nothing by
/// them.
FrameWay chooseFrameWay(const DeviceIdentity& device);

} // namespace hearth::gpu
