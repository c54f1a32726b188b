// Validates all invariants of a hierarchy; slow and simple, for tests.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/hierarchy.h"
#include "formats/base/result.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::clusters
{

/// Triangles of all clusters, decoded from the pages.
struct DecodedHierarchy
{
    std::vector<std::vector<std::byte>> pages; ///< decoded
    std::vector<Float3> positions;             ///< distinct positions
    struct Cluster
    {
        /// Three position ids for each triangle, into DecodedHierarchy::positions.
        std::vector<uint32_t> positions;
    };
    std::vector<Cluster> clusters;
};

/// errors: page_hash, chunk_codec, meaning_geometry.
Result<DecodedHierarchy> decodeHierarchy(const Hierarchy& hierarchy);

/// Return the clusters that are drawn when exactly the groups with replaced[g] != 0 are replaced.
/// replaced  monotone: a group may only be replaced if the groups that its clusters were made from are
std::vector<uint32_t> findCutClusters(const Hierarchy& hierarchy, std::span<const uint8_t> replaced);

/// Check that tables are in range and in order; that level 0 has each source triangle with an area once, with
/// its attributes and material; that errors and spheres are monotone; that boxes, spheres and cones contain;
/// and pages as in formats/records/mesh.h. errors: meaning_*, page_hash, chunk_codec.
Status validateHierarchy(const mesh::SourceMesh& source, const Hierarchy& hierarchy,
                         std::span<const mesh::SourceMesh> authored = {});

} // namespace hearth::clusters
