// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/pyramid_start.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace hearth::viewer
{

Status writeNoise(VulkanHost& host, const gpu::Device& device, gpu::FrameTargets& targets,
                  const shared::OcclusionView& view, uint32_t seed)
{
    // limit of one vkCmdUpdateBuffer
    constexpr size_t kMaxTexels = 65536 / sizeof(float);
    // depths are reciprocals of distances: limits from 1 to 2^-12 reach from the near plane to far away
    constexpr uint32_t kLimits = 13;
    std::mt19937 random(seed);
    const float limit = std::ldexp(1.0f, -static_cast<int>(random() % kLimits));
    std::vector<float> texels(static_cast<size_t>(targets.pyramid().size) / sizeof(float));
    for (float& texel : texels)
        texel = std::ldexp(static_cast<float>(random() >> 8), -24) * limit;
    HEARTH_TRY(host.run(
        [&](VkCommandBuffer commands)
        {
            for (size_t at = 0; at < texels.size(); at += kMaxTexels)
                device.vk.vkCmdUpdateBuffer(commands, targets.pyramid().handle.get(), at * sizeof(float),
                                            std::min(kMaxTexels, texels.size() - at) * sizeof(float),
                                            &texels[at]);
            return success();
        }));
    targets.setPyramidView(view);
    return success();
}

} // namespace hearth::viewer
