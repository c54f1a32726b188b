// Levels of detail that somebody made by hand, in one mesh with their source. See cook/clusters/README.md, "Authored levels".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/cluster.h"
#include "cook/clusters/core/hierarchy.h"
#include "cook/clusters/error/attribute_error.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hearth::clusters
{

/// The triangles of a level, with the vertices of the prepared mesh.
struct AuthoredLevel
{
    std::vector<uint32_t> corners;   ///< three vertices for each triangle
    std::vector<uint32_t> materials; ///< for each triangle
    size_t authored = 0;             ///< which of the authored meshes it is

    size_t triangleCount() const { return materials.size(); }
};

struct JoinedMesh
{
    PreparedMesh mesh; ///< with the vertices of all, and the triangles of the source
    std::vector<AuthoredLevel> levels;
};

/// Put a source and what was made of it by hand on one grid. The levels get the attributes that the source has: they lose
/// what they have besides, and what they lack is 0, white, or made up from the normal. A level that has not fewer
/// triangles than the one before it, or than the source, is left out: it would cost more and show less.
JoinedMesh joinAuthored(mesh::SourceMesh source, std::span<const mesh::SourceMesh> authored,
                        uint32_t influences = 8, const MeshMotion* motion = nullptr);

/// Compare the attributes of a level with those of the source, whose triangles are `source_corners`: at the middles of at
/// most 131072 of these, evenly through their order, and the points of the level that are nearest to them.
AttributeStep measureAttributes(const PreparedMesh& mesh, std::span<const uint32_t> source_corners,
                                const AuthoredLevel& level);

/// Link each page to those that it needs, where groups switch together: as pages.h says, but each group of a set
/// needs all that was made in place of the set.
void linkPagesOfSets(Hierarchy& hierarchy);

} // namespace hearth::clusters
