// Chunks that record the origin of a pack's contents, for people and tools. A runtime draws without them. See
// FORMAT.md, "Provenance".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/container.h"

#include <algorithm>

namespace hearth::formats
{

inline constexpr uint32_t kChunkAuthoredLevels = fourCC("ALVL"); ///< AuthoredLevelRecord[]

/// Authored level of a mesh. Sorted by mesh, then level; no level appears twice.
struct AuthoredLevelRecord
{
    uint32_t mesh;
    uint32_t level;
    uint32_t number;
    StringRef name;
};

/// AssetRecord[]: one for each source, in source order
inline constexpr uint32_t kChunkAssets = fourCC("ASST");

/// Source of the pack: its records, and its bounding box at rest.
struct AssetRecord
{
    StringRef name;
    Range instances;
    Range meshes;
    Range nodes;
    Float3 box_min;
    Float3 box_max;
};

/// Return the largest side of the box in metres; 0 if the asset draws nothing.
inline float largestSide(const AssetRecord& asset)
{
    const Float3 sides = asset.box_max - asset.box_min;
    return std::max({sides.x, sides.y, sides.z});
}

} // namespace hearth::formats

HEARTH_RECORD(hearth::formats::AuthoredLevelRecord, 20,
              HEARTH_FIELD(hearth::formats::AuthoredLevelRecord, mesh, "chunk MESH"),
              HEARTH_FIELD(hearth::formats::AuthoredLevelRecord, level,
                           "of the mesh's levels, counted from its finest; never 0"),
              HEARTH_FIELD(hearth::formats::AuthoredLevelRecord, number,
                           "3 of rock_LOD3; none where nobody gave it a number"),
              HEARTH_FIELD(hearth::formats::AuthoredLevelRecord, name,
                           "of the file or node that it came from; may be empty"));
HEARTH_RECORD(hearth::formats::AssetRecord, 56,
              HEARTH_FIELD(hearth::formats::AssetRecord, name,
                           "file name of the source without its extension; may be that of others"),
              HEARTH_FIELD(hearth::formats::AssetRecord, instances, "records of chunk INST"),
              HEARTH_FIELD(hearth::formats::AssetRecord, meshes, "records of chunk MESH"),
              HEARTH_FIELD(hearth::formats::AssetRecord, nodes, "records of chunk NODE"),
              HEARTH_FIELD(hearth::formats::AssetRecord, box_min,
                           "world, metres, at rest; 0 where the asset draws nothing"),
              HEARTH_FIELD(hearth::formats::AssetRecord, box_max, "the same"));
