// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/topology/topology.h"

#include "cook/mesh/weld.h"
#include "formats/base/double3.h"

namespace hearth::topology
{

namespace
{

uint32_t countDuplicates(const mesh::SourceMesh& mesh)
{
    const std::vector<uint32_t> first = mesh::firstEqualVertices(mesh);
    uint32_t count = 0;
    for (uint32_t vertex = 0; vertex < first.size(); ++vertex)
        count += first[vertex] == vertex ? 0 : 1;
    return count;
}

std::vector<uint32_t> findUnreferenced(const mesh::SourceMesh& mesh)
{
    std::vector<bool> is_used(mesh.vertexCount(), false);
    for (const uint32_t vertex : mesh.indices)
        is_used[vertex] = true;
    std::vector<uint32_t> found;
    for (uint32_t vertex = 0; vertex < is_used.size(); ++vertex)
        if (!is_used[vertex])
            found.push_back(vertex);
    return found;
}

} // namespace

Topology analyzeTopology(const mesh::SourceMesh& mesh)
{
    Topology topology;
    topology.duplicate_vertices = countDuplicates(mesh);
    topology.unreferenced_vertices = findUnreferenced(mesh);
    topology.surface = makeSurface(mesh);
    for (const uint32_t corner : topology.surface.corners)
        topology.box.add(topology.surface.positions[corner]);
    if (topology.surface.triangleCount() == 0)
        return topology;
    topology.edges = findEdges(topology.surface);
    topology.components = countComponents(topology.surface);
    topology.shells = findShells(topology.surface, topology.edges);
    topology.boundary_loops = findBoundaryLoops(topology.surface, topology.edges);
    topology.non_manifold_edges = findNonManifoldEdges(topology.edges);
    topology.non_manifold_vertices = findNonManifoldVertices(topology.surface, topology.edges);
    topology.inconsistent_edges = findInconsistentEdges(topology.surface, topology.edges);
    const double diagonal = length(widen(topology.box.max) - widen(topology.box.min));
    topology.t_junction_tolerance = kTJunctionTolerance * diagonal;
    topology.t_junctions = findTJunctions(topology.surface, topology.edges, topology.t_junction_tolerance);
    return topology;
}

} // namespace hearth::topology
