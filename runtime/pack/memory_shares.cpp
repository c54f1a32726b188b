// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/memory_shares.h"

#include <algorithm>

namespace hearth::pack
{

MemoryShares divideMemory(uint64_t budget_bytes, const PageGraph& pages, const PageGraph& textures)
{
    const uint64_t geometry = pages.streamedBytes(), texels = textures.streamedBytes();
    const uint64_t rest = budget_bytes - std::min(budget_bytes, pages.pinnedBytes() + textures.pinnedBytes());
    const uint64_t unused = rest - std::min(rest, geometry);
    const uint64_t share = textures.pinnedBytes() + std::min(texels, std::max(rest / 2, unused));
    return {budget_bytes - std::min(budget_bytes, share), share};
}

} // namespace hearth::pack
