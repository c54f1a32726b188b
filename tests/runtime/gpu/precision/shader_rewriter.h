// Gives a renderer other shaders than its own.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/vulkan/device.h"

#include <functional>
#include <span>
#include <vector>

namespace hearth::test
{

using RewriteShader = std::function<std::vector<uint32_t>(std::span<const uint32_t> words)>;

/// Return the description with an entry point that rewrites the modules of shaders. The last call counts
/// for all renderers that such descriptions made.
gpu::DeviceDescription rewriteShaders(const gpu::DeviceDescription& description, RewriteShader rewrite);

} // namespace hearth::test
