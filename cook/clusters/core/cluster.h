// Data that the stages of the builder exchange: the prepared mesh, and clusters before they become records.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/index_types.h"
#include "cook/clusters/core/mesh_motion.h"
#include "cook/mesh/deformation.h"
#include "cook/mesh/grid.h"
#include "cook/mesh/source_mesh.h"
#include "formats/base/assert.h"
#include "formats/records/mesh.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hearth::clusters
{

/// Prepared mesh: the triangles that remain and the vertices of all levels. A vertex is an index into the
/// arrays of `vertices`: first those of the source (the first of equal ones), then those that simplification
/// made.
struct PreparedMesh
{
    mesh::SourceMesh vertices; ///< on the grid; without indices and materials
    mesh::Grid grid;
    uint32_t attributes = 0;
    uint32_t degenerate_count = 0;
    uint32_t position_count = 0;
    Box3 box;                   ///< of the triangles, those of authored LODs included
    bool gently_curved = false; ///< normals need more than 8 bits
    CornerVector<VertexId> corners;
    IdVector<TriangleId, uint32_t> materials;
    IdVector<VertexId, MeshPositionId> position_id_of_vertex;
    const MeshMotion* motion = nullptr; ///< motion of a deformed mesh; null: nothing moves it
    mesh::InfluenceLoss influence_loss;
    std::optional<double> influence_displacement; ///< as in BuildCounts
    std::vector<uint8_t> read_uv_sets;            ///< as in Config
    std::vector<float> morph_steps;               ///< step of each morph target's deltas; a power of two

    size_t triangleCount() const { return corners.triangleCount(); }
    IdSpan<VertexId, const Float3> positions() const
    {
        return IdSpan<VertexId, const Float3>(vertices.positions);
    }
    bool deforms() const { return !vertices.joint_sets.empty() || !vertices.morph_targets.empty(); }
};

/// First id of the vertices that a simplification makes while its level is unfinished. They are not in the
/// prepared mesh yet: kFirstNewVertex + k is the k-th.
inline constexpr uint32_t kFirstNewVertex = 0x80000000u;

constexpr VertexId makeNewVertex(uint32_t number)
{
    return VertexId{kFirstNewVertex + number};
}
constexpr bool isNewVertex(VertexId vertex)
{
    return toIndex(vertex) >= kFirstNewVertex;
}
constexpr uint32_t newVertexNumber(VertexId vertex)
{
    HEARTH_RUNTIME_ASSERT(isNewVertex(vertex));
    return toIndex(vertex) - kFirstNewVertex;
}

/// Return the maximum vertices of a cluster: below the format's limit where the morph targets of two clusters
/// would not fit into a page.
uint32_t clusterVertexLimit(const PreparedMesh& mesh);

/// Round a number of triangles down to full clusters, or return it unchanged if it is less than one cluster.
inline size_t roundToFullClusters(size_t triangles)
{
    return triangles < formats::kMaxClusterTriangles
               ? triangles
               : triangles / formats::kMaxClusterTriangles * formats::kMaxClusterTriangles;
}

/// Triangles of a cluster: three u8 indices into its own list of vertices.
struct ClusterShape
{
    uint32_t first_vertex = 0; ///< in ClusterStore::vertices
    uint32_t vertex_count = 0;
    uint32_t first_index = 0; ///< in ClusterStore::indices
    uint32_t triangle_count = 0;
    uint32_t material = 0;
};

/// Clusters with their vertices, indices and errors in shared arrays.
struct ClusterStore
{
    IdVector<ClusterId, ClusterShape> shapes;
    std::vector<VertexId> vertices;
    std::vector<uint8_t> indices;
    /// Error of each triangle, object space: bounds the distance to the source in both directions.
    std::vector<float> errors;

    std::span<const VertexId> clusterVertices(const ClusterShape& shape) const
    {
        HEARTH_RUNTIME_ASSERT(shape.first_vertex + shape.vertex_count <= vertices.size());
        return std::span(vertices).subspan(shape.first_vertex, shape.vertex_count);
    }
    std::span<const uint8_t> clusterIndices(const ClusterShape& shape) const
    {
        HEARTH_RUNTIME_ASSERT(shape.first_index + size_t{shape.triangle_count} * 3 <= indices.size());
        return std::span(indices).subspan(shape.first_index, size_t{shape.triangle_count} * 3);
    }

    std::span<const float> clusterErrors(const ClusterShape& shape) const
    {
        HEARTH_RUNTIME_ASSERT(shape.first_index / 3 + shape.triangle_count <= errors.size());
        return std::span(errors).subspan(shape.first_index / 3, shape.triangle_count);
    }

    /// Append all clusters of `other`, in order.
    void append(const ClusterStore& other);

    /// Append a copy of one cluster of `other`.
    void appendCluster(const ClusterStore& other, const ClusterShape& shape);
};

/// Append a copy of a vertex with its position and attributes.
void appendVertex(mesh::SourceMesh& to, const mesh::SourceMesh& from, uint32_t vertex);

/// Append all vertices of `from`, which has the same attributes.
void appendVertices(mesh::SourceMesh& to, const mesh::SourceMesh& from);

/// Move a mesh to the grid, weld it, drop triangles without area and triangles that lose an edge on the grid,
/// and merge equal vertices. Deformation data is reduced to what pages can hold: at most `influences` (4 or
/// 8) for each vertex, as codes, and quantized morph deltas.
PreparedMesh prepareMesh(mesh::SourceMesh source, uint32_t influences = 8,
                         const MeshMotion* motion = nullptr);

} // namespace hearth::clusters
