// Division of a scene's memory budget between pages of geometry and mips of textures.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/pack/page_graph.h"

namespace hearth::pack
{

/// Shares of the budget, in bytes.
struct MemoryShares
{
    uint64_t geometry = 0;
    uint64_t textures = 0;
};

/// Divide the budget. Both sides get what is always resident, and halves of the rest; what one cannot use,
/// the other gets. The bytes that a view wants of either are bounded by its pixels, however large the pack
/// is: so shares in proportion to all pages and all mips would leave the smaller side short.
/// pages     with the sizes of their slots (PageGraph::withSlotSize)
/// textures  TextureGraph::nodes
MemoryShares divideMemory(uint64_t budget_bytes, const PageGraph& pages, const PageGraph& textures);

} // namespace hearth::pack
