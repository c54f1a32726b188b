// The mesh that visibility is fitted on: one vertex where the source has several, and no triangle that is all but a
// line. See cook/visibility/README.md, "The proxy".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/mesh/interior_edges.h"
#include "cook/visibility/mesh/mesh_view.h"
#include "cook/visibility/mesh/moments.h"
#include "cook/visibility/mesh/thin_triangles.h"

#include <array>
#include <vector>

namespace hearth::visibility
{

struct ProxySettings
{
    /// Positions as far apart, by the farther of the mesh's longest side and its farthest coordinate, are one: two
    /// steps of a float there. Import's grids are coarser or as fine as floats allow.
    double position_tolerance = 0x1p-22;
    /// Normals as far apart in each axis face the same way: six degrees. Facets of rounded shapes are often less far
    /// apart; edges that are meant to be hard, more.
    double normal_tolerance = 0.1;
    /// Least height of a triangle by its longest edge. The condition of the fit grows with the square of its inverse.
    double thinness = 1e-3;
};

/// What a vertex of the source is on the proxy: a weighted sum of three vertices. Vertices that are one vertex of the
/// proxy have all three equal and the weights (1, 0, 0): what they get is equal in every bit.
struct Binding
{
    std::array<uint32_t, 3> vertices{kNowhere, kNowhere, kNowhere};
    std::array<float, 3> weights{1, 0, 0};
};

struct ProxyStatistics
{
    uint32_t source_vertices = 0;
    uint32_t welded = 0; ///< vertices of the source that are one with an earlier one
    ThinStatistics thin;
    uint32_t loose = 0; ///< triangles too thin that are kept because nothing else holds their vertices
    uint32_t nearest =
        0; ///< vertices of the source that no triangle was left of: they have the value of the nearest point
};

struct Proxy
{
    std::vector<Float3> positions;
    std::vector<Float3> normals;
    std::vector<uint32_t>
        indices; ///< the first `smooth_count` triangles, then loose ones, which may name a vertex twice
    size_t smooth_count = 0;         ///< triangles that the regulariser sees
    double thinness = 0;             ///< that it was made with
    std::vector<InteriorEdge> edges; ///< of the smooth triangles
    std::vector<Binding> bindings;   ///< for each vertex of the source; kNowhere where the proxy is empty
    std::vector<uint32_t>
        triangle_of_source; ///< with the three vertices of the source triangle's, or kNowhere
    ProxyStatistics statistics;

    MeshView view() const { return {positions, normals, indices}; }
};

/// For each vertex the first that is one with it on the proxy, by place and normal alone: itself if there is none.
std::vector<uint32_t> proxyVertices(const MeshView& source, const ProxySettings& settings = {});

/// Deterministic. Time O(n log n).
Proxy makeProxy(const MeshView& source, const ProxySettings& settings = {});

/// Where samples of the source's triangles lie on the proxy: on triangles that are still there with the same weights,
/// else at the nearest point that faces the same way. Their triangle is kNowhere if there is none where their own
/// was: a sliver can face anywhere, and what it sees then is nothing that the surface sees.
std::vector<SurfaceSample> samplesOnProxy(const Proxy& proxy, const MeshView& source,
                                          std::span<const SurfaceSample> samples);

/// Values of the proxy's vertices, brought back to the source's. Where the proxy is empty: the open hemisphere about
/// the vertex' normal.
std::vector<Moments> valuesOfSource(const Proxy& proxy, std::span<const Moments> values,
                                    std::span<const Float3> source_normals);

} // namespace hearth::visibility
