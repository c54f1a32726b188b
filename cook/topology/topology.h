// All findings about the topology of a mesh. See cook/topology/README.md.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/topology/boundary_loops.h"
#include "cook/topology/edges.h"
#include "cook/topology/shells.h"
#include "cook/topology/surface.h"
#include "cook/topology/t_junctions.h"
#include "cook/topology/vertex_fans.h"

namespace hearth::topology
{

/// Distance of T-junctions, relative to the diagonal of a mesh's box: what some rounded operations on
/// float coordinates leave, each 6e-8.
inline constexpr double kTJunctionTolerance = 1e-6;

struct Topology
{
    Surface surface;
    Edges edges;
    Box3 box;
    uint32_t components = 0;
    Shells shells;
    std::vector<BoundaryLoop> boundary_loops;
    std::vector<uint32_t> non_manifold_edges;
    std::vector<NonManifoldVertex> non_manifold_vertices;
    std::vector<uint32_t> inconsistent_edges;
    double t_junction_tolerance = 0; ///< in units of the mesh
    std::vector<TJunction> t_junctions;
    uint32_t duplicate_vertices = 0;             ///< vertices that equal an earlier one in every array
    std::vector<uint32_t> unreferenced_vertices; ///< vertices without a triangle, ascending
};

/// Find everything. Deterministic for any number of threads. Time O(n log n).
/// mesh  as the importer writes it; any soup of triangles
Topology analyzeTopology(const mesh::SourceMesh& mesh);

} // namespace hearth::topology
