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

/// Divide the budget. Both sides get what is always resident. The rest is divided as the bytes of all pages
/// and of all mips, since views that want too much have both coarsened by a common factor then: the bytes of
/// either fall with its square. A side gets at least a quarter of the rest, as far as it has use for it: a
/// view may want all pages and few mips, or the reverse.
/// pages     with the sizes of their slots (PageGraph::withSlotSize)
/// textures  TextureGraph::nodes
MemoryShares divideMemory(uint64_t budget_bytes, const PageGraph& pages, const PageGraph& textures);

} // namespace hearth::pack
