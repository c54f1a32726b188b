// FitMesh: the mesh that visibility is fitted on, with duplicate vertices welded and sliver triangles
// removed. See cook/visibility/README.md, "The fit mesh".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/mesh/interior_edges.h"
#include "cook/mesh/thin_triangles.h"
#include "cook/visibility/mesh/moments.h"
#include "cook/visibility/mesh/surface_sample.h"

#include <array>
#include <vector>

namespace hearth::visibility
{

struct FitMeshSettings
{
    /// Maximum distance of positions that are welded, relative to the larger of the mesh's longest side and
    /// its largest absolute coordinate: two steps of a float there. Import's quantization grids are coarser,
    /// or as fine as floats allow.
    double position_tolerance = 0x1p-22;
    /// Maximum difference of normals that are welded, in each axis: six degrees. Facets of rounded shapes
    /// often differ by less; intended hard edges differ by more.
    double normal_tolerance = 0.1;
    /// Minimum height of a triangle divided by its longest edge. The condition number of the fit grows with
    /// the inverse square of this.
    double thinness = 1e-3;
};

/// Weighted sum of three fit mesh vertices that a source vertex maps to. A source vertex that was merged into
/// one fit mesh vertex has it three times, with the weights (1, 0, 0): its value is copied bit for bit.
struct Binding
{
    std::array<uint32_t, 3> vertices{kInvalidIndex, kInvalidIndex, kInvalidIndex};
    std::array<float, 3> weights{1, 0, 0};
};

struct FitMeshStatistics
{
    uint32_t source_vertices = 0;
    uint32_t welded = 0; ///< source vertices merged into an earlier one
    mesh::ThinTriangleStatistics thin;
    uint32_t loose = 0; ///< thin triangles that are kept because nothing else holds their vertices
    /// Source vertices without a remaining triangle; they take the value of the nearest point.
    uint32_t nearest = 0;
};

struct FitMesh
{
    std::vector<Float3> positions;
    std::vector<Float3> normals;
    /// The first `smooth_count` triangles, then loose triangles, which may name a vertex twice.
    std::vector<uint32_t> indices;
    size_t smooth_count = 0;               ///< triangles that the regulariser covers
    double thinness = 0;                   ///< setting that the fit mesh was made with
    std::vector<mesh::InteriorEdge> edges; ///< interior edges of the smooth triangles
    std::vector<Binding> bindings;         ///< for each source vertex; kInvalidIndex if the fit mesh is empty
    /// For each source triangle, the fit mesh triangle with the same three vertices, or kInvalidIndex.
    std::vector<uint32_t> triangle_of_source;
    FitMeshStatistics statistics;

    MeshView view() const { return {positions, normals, indices}; }
};

/// Return for each vertex the first vertex that the fit mesh merges it with, by position and normal alone;
/// the vertex itself if there is none.
std::vector<uint32_t> findMergedVertices(const MeshView& source, const FitMeshSettings& settings = {});

/// Build the fit mesh. Deterministic. Time O(n log n).
FitMesh makeFitMesh(const MeshView& source, const FitMeshSettings& settings = {});

/// Map samples of the source's triangles to the fit mesh: with the same weights on triangles that still
/// exist, else to the nearest point that faces the same way. The triangle is kInvalidIndex if no such point
/// is near: a sliver can face anywhere, and its visibility is then unrelated to the surface's.
std::vector<SurfaceSample> mapSamplesToFitMesh(const FitMesh& fit_mesh, const MeshView& source,
                                               std::span<const SurfaceSample> samples);

/// Map values of the fit mesh's vertices back to the source's vertices. If the fit mesh is empty, return the
/// open hemisphere about each vertex normal.
std::vector<Moments> mapValuesToSource(const FitMesh& fit_mesh, std::span<const Moments> values,
                                       std::span<const Float3> source_normals);

} // namespace hearth::visibility
