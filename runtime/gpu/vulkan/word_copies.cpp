// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/vulkan/word_copies.h"

#include "formats/base/assert.h"

#include <algorithm>
#include <cstring>

namespace hearth::gpu
{

uint32_t WordCopies::countRegions(uint64_t words)
{
    return static_cast<uint32_t>((words + shared::kMaxCopyWords - 1) / shared::kMaxCopyWords);
}

void WordCopies::add(uint32_t source, uint32_t target, uint32_t words)
{
    for (uint32_t done = 0; done < words; done += shared::kMaxCopyWords)
    {
        const shared::CopyRegion region{source + done, target + done,
                                        std::min(words - done, shared::kMaxCopyWords), 0};
        const size_t at = size_t{range_.first} + range_.count++;
        HEARTH_ASSERT((at + 1) * sizeof(region) <= regions_.size);
        std::memcpy(regions_.mapped + at * sizeof(region), &region, sizeof(region));
    }
}

void prepareCopyRegions(const Buffer& regions)
{
    const uint32_t flags[] = {0, 1, 0, 0};
    static_assert(sizeof(flags) == sizeof(shared::CopyRegion));
    std::memcpy(regions.mapped, flags, sizeof(flags));
}

} // namespace hearth::gpu
