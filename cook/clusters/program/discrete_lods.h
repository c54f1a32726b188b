// Measures discrete LODs: a chain of whole meshes, as a baseline for the hierarchy's bytes.
// See cook/clusters/README.md, "Against discrete LODs".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/hierarchy.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hearth::clusters
{

/// Length of the chain: all triangles, at most a half, a quarter, an eighth and a sixteenth of them.
inline constexpr uint32_t kDiscreteLodCount = 5;

struct DiscreteLod
{
    uint64_t triangles = 0;
    uint64_t vertices = 0; ///< distinct vertices
};

struct DiscreteLods
{
    std::vector<DiscreteLod> lods; ///< finest first; fewer than five if the hierarchy ends before
    uint64_t bytes = 0;            ///< vertices and indices in memory
    uint64_t bytes_zstd = 0;       ///< vertices and indices of each mesh, each compressed as a zstd frame
};

/// Measure the chain whose meshes are cuts of the hierarchy: each the finest that has few enough triangles. A
/// vertex takes the bytes of a vertex in a narrow cluster of the hierarchy, without morph targets. An index
/// takes 16 bits, or 32 in meshes of more than 65536 vertices. Time and memory as for a few copies of the
/// mesh.
DiscreteLods measureDiscreteLods(const Hierarchy& hierarchy);

/// Return the bytes of the hierarchy in a file, for comparison: its pages and its tables, compressed by zstd.
uint64_t storedBytes(const Hierarchy& hierarchy);

} // namespace hearth::clusters
