// Checks everything that a hierarchy promises; slow and obvious, for tests.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/hierarchy.h"
#include "formats/base/result.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::clusters
{

/// The triangles of all clusters, read back from the pages.
struct DecodedHierarchy
{
    std::vector<std::vector<std::byte>> pages; ///< decoded
    std::vector<Float3> positions;             ///< distinct places
    struct Cluster
    {
        std::vector<uint32_t> positions; ///< three for each triangle, into DecodedHierarchy::positions
    };
    std::vector<Cluster> clusters;
};

/// errors: page_hash, chunk_codec, meaning_geometry.
Result<DecodedHierarchy> decodeHierarchy(const Hierarchy& hierarchy);

/// The clusters that are drawn when exactly the groups with replaced[g] != 0 are replaced.
/// replaced  monotone: a group may only be replaced if the groups that its clusters were made from are
std::vector<uint32_t> clustersOfCut(const Hierarchy& hierarchy, std::span<const uint8_t> replaced);

/// Tables in range and in order; level 0 holds each source triangle that has an area once, with its attributes and
/// material; errors and spheres monotone; boxes, spheres and cones contain; pages as formats/records/mesh.h says.
/// errors: meaning_*, page_hash, chunk_codec.
Status validateHierarchy(const mesh::SourceMesh& source, const Hierarchy& hierarchy,
                         std::span<const mesh::SourceMesh> authored = {});

} // namespace hearth::clusters
