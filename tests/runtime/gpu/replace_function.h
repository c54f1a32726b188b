// Replaces entry points of Vulkan, for tests that watch what the renderer asks of the driver.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/vulkan/device.h"

namespace hearth::test
{

/// Store an entry point in `real`, and return `replacement` in its place.
template <typename T>
PFN_vkVoidFunction replaceFunction(PFN_vkVoidFunction function, T& real, T replacement)
{
    real = reinterpret_cast<T>(function);
    return reinterpret_cast<PFN_vkVoidFunction>(replacement);
}

} // namespace hearth::test
