// Cluster hierarchy (levels of detail) of one mesh as plain data, and the function that builds it. See
// cook/clusters/README.md.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/mesh_motion.h"
#include "cook/clusters/core/reduction.h"
#include "cook/mesh/deformation.h"
#include "cook/mesh/source_mesh.h"
#include "formats/records/mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::clusters
{

/// Settings of the cluster builder.
struct Config
{
    /// Clusters of a group: merging stops at the target and never passes the maximum. Bigger groups lock
    /// fewer vertices; past 24 the gain is under 3 % and streaming gets coarser.
    uint32_t group_target_clusters = 16;
    uint32_t group_max_clusters = 24;

    /// Target size of each level and weight of its error.
    Reduction reduction;

    /// Number of times that a stuck group passes unchanged to the next level, to be tried with other
    /// neighbours, before it stays as a root. Each time costs a copy of its geometry.
    uint32_t max_retries = 2;

    /// Weights of attribute errors against position errors. A difference of normals or UVs counts as the
    /// length on the surface over which the group's normals or UVs change by as much. A difference of colours
    /// counts as a length in units of the group's radius. With about a quarter, distance and normals gain
    /// about alike over clusterlod (`./dev bench clusters`).
    float normal_weight = 0.23f;
    float uv_weight = 0.25f;
    float color_weight = 0.25f;

    /// Weights of the attribute errors of a group, against its distance, in the error that chooses the cut.
    /// UVs count by their shift on the surface. Normals count by the height of a wave with that slope, as
    /// long as the new triangles' edges. 0: no weight. Measurements:
    /// cook/clusters/README.md, "Normals and UVs".
    float normal_error_weight = 1;
    float uv_error_weight = 0.25f;

    /// Bits of each of the two parts of a normal's code: 8 are off by at most 0.7 degrees, 16 by 0.003. 0: 16
    /// for smooth meshes, whose highlights would be ragged with 8, and 8 for others.
    uint32_t normal_bits = 0;

    /// UVs lie on a grid of steps 2^-n, 1 <= n <= 15, within its range. 14: off by at most an eighth of a
    /// texel of a texture of 4096.
    uint32_t uv_fraction_bits = 14;

    /// Maximum joints of a vertex of a skinned mesh, 4 or 8: those with the largest weights.
    uint32_t influences = 8;

    /// Give vertices with normals a visibility, open until it is baked.
    bool visibility = false;

    /// UV sets that textures of each material read: bit k for set k. By these the density of UVs on clusters
    /// is measured; all sets count for materials beyond the list.
    std::vector<uint8_t> read_uv_sets;
};

/// Counters for the report.
struct BuildCounts
{
    uint64_t permissive_groups = 0;     ///< groups with attributes that jump across seams
    uint64_t pruned_groups = 0;         ///< groups that lost whole islands
    uint64_t merged_groups = 0;         ///< groups whose positions were merged by cells
    uint64_t retried_groups = 0;        ///< groups that passed unchanged to the next level
    uint64_t stuck_groups = 0;          ///< roots other than the last one of the hierarchy
    uint64_t loose_pieces = 0;          ///< pieces of triangles whose search ended early, with a loose bound
    mesh::InfluenceLoss influence_loss; ///< influences beyond Config::influences that were dropped
    /// Bound of the distance that dropped influences would move a vertex (influence_displacement.h); nothing
    /// if it is unbounded or the motion is unknown.
    std::optional<double> influence_displacement;
};

/// Hierarchy of one mesh as in formats/records/mesh.h, with indices that start at 0. Clusters, groups and
/// pages are ordered coarse to fine, levels fine to coarse. The caller sets the name in `mesh`.
struct Hierarchy
{
    formats::MeshRecord mesh{};
    std::vector<formats::LevelRecord> levels;
    std::vector<formats::GroupRecord> groups;
    std::vector<formats::ClusterRecord> clusters;
    std::vector<formats::PageRecord> pages;
    std::vector<uint32_t> page_parents;
    std::vector<std::byte> page_bytes; ///< the stored pages, each at a multiple of 64
    /// Level of each authored mesh; kInvalidIndex: it was left out.
    std::vector<uint32_t> authored_levels;
    BuildCounts counts;
};

/// Build the hierarchy of a mesh. Deterministic: the same bytes for any number of threads. Time O(n log n);
/// memory about 200 bytes for each source triangle.
///
/// source   finite, indices in range (the contract of SourceMesh); any topology, any number of triangles; its
///          positions move to the grid (mesh/grid.h)
/// motion   of a mesh with joints or morph targets: errors hold in all its poses; null: nothing moves it
/// returns  a hierarchy that validateHierarchy accepts; without clusters if no triangle has an area
Hierarchy buildHierarchy(mesh::SourceMesh source, const Config& config = {},
                         const MeshMotion* motion = nullptr);

/// Build the hierarchy of a mesh with authored LODs, finest first, in the source's object space. Each is used
/// from where the generated levels would have fewer triangles. The whole mesh switches to it at once.
Hierarchy buildHierarchy(mesh::SourceMesh source, std::span<const mesh::SourceMesh> authored,
                         const Config& config, const MeshMotion* motion = nullptr);

} // namespace hearth::clusters
