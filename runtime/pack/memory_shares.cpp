// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/memory_shares.h"

#include <algorithm>

namespace hearth::pack
{

namespace
{

/// Return the bytes of the nodes that may be evicted.
uint64_t streamedBytes(const PageGraph& graph)
{
    uint64_t bytes = 0;
    for (uint32_t node = 0; node < graph.pageCount(); ++node)
        bytes += graph.isPinned(node) ? 0 : graph.sizeBytes(node);
    return bytes;
}

} // namespace

MemoryShares divideMemory(uint64_t budget_bytes, const PageGraph& pages, const PageGraph& textures)
{
    const uint64_t geometry = streamedBytes(pages), texels = streamedBytes(textures);
    const uint64_t rest = budget_bytes - std::min(budget_bytes, pages.pinnedBytes() + textures.pinnedBytes());
    const uint64_t quarter = rest / 4;
    const double part =
        static_cast<double>(texels) / static_cast<double>(std::max<uint64_t>(geometry + texels, 1));
    uint64_t share = texels;
    if (geometry + texels > rest)
        share = std::clamp(static_cast<uint64_t>(part * static_cast<double>(rest)), std::min(texels, quarter),
                           rest - std::min(geometry, quarter));
    share += textures.pinnedBytes();
    return {budget_bytes - std::min(budget_bytes, share), share};
}

} // namespace hearth::pack
