// Reads the lists of lights that a frame has left.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/statistics/light_statistics_pass.h"

#include <cstring>
#include <vector>

namespace hearth::test
{

/// Return the words of the last frame's lists: counts, numbers of lights, cells, and all indices that are in
/// use.
inline std::vector<uint32_t> readLightWords(const gpu::Scene& scene)
{
    const gpu::LightBufferLayout& layout = scene.lights->layout();
    const std::byte* mapped = scene.tables->lighting.copy(scene.tables->frame).mapped;
    const shared::LightListCounts counts = gpu::readLightCounts(scene);
    std::vector<uint32_t> words;
    const auto add = [&](VkDeviceSize offset, size_t count)
    {
        words.resize(words.size() + count);
        std::memcpy(words.data() + words.size() - count, mapped + offset, count * sizeof(uint32_t));
    };
    add(layout.lists, shared::kLightCountWords + counts.unranged + counts.ranged);
    add(layout.cells, scene.lights->grid().cell_count);
    if (counts.overflows == 0)
        add(layout.indices, counts.index_words);
    return words;
}

} // namespace hearth::test
