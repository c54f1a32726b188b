// What levels of detail by hand would take: a chain of whole meshes, to hold the hierarchy's bytes against.
// See cook/clusters/README.md, "Against levels by hand".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/hierarchy.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hearth::clusters
{

/// Levels of a chain: all triangles, at most a half, a quarter, an eighth and a sixteenth of them.
inline constexpr uint32_t kManualLodCount = 5;

struct ManualLod
{
    uint64_t triangles = 0;
    uint64_t vertices = 0; ///< distinct ones
};

struct ManualLods
{
    std::vector<ManualLod> lods; ///< finest first; fewer than five where the hierarchy ends before
    uint64_t bytes = 0;          ///< vertices and indices as they are drawn
    uint64_t bytes_zstd = 0;     ///< the same, each mesh's vertices and its indices as a zstd frame
};

/// Count the chain whose meshes are cuts of the hierarchy: each the finest that has few enough triangles. A vertex takes
/// the bytes that it has in a narrow cluster of the hierarchy, morph targets aside, an index 16 bits, or 32 in meshes of more than 65536
/// vertices. Time and memory as for a few copies of the mesh.
ManualLods measureManualLods(const Hierarchy& hierarchy);

/// Bytes of the hierarchy in a file, for comparison: its pages and its tables, which are packed by zstd.
uint64_t storedBytes(const Hierarchy& hierarchy);

} // namespace hearth::clusters
