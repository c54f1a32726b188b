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
    const uint64_t unused = rest - std::min(rest, geometry);
    const uint64_t share = textures.pinnedBytes() + std::min(texels, std::max(rest / 2, unused));
    return {budget_bytes - std::min(budget_bytes, share), share};
}

} // namespace hearth::pack
