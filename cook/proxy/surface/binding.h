// Binds the vertices of a mesh to its proxy, and bounds the distance between both.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/proxy/surface/cut.h"
#include "cook/proxy/surface/surface.h"
#include "formats/records/proxy.h"

#include <array>
#include <map>
#include <vector>

namespace hearth::proxy
{

/// Bind each vertex to the closest point of the proxy whose triangle faces the way of its normal, unless the
/// closest point of all is much closer: then to that one. Runs on all cores.
/// proxy  at least one triangle
std::vector<formats::ProxyBindingRecord> bindVertices(const FinestVertices& vertices, const Surface& proxy);

/// Distances between a mesh and its proxy, in metres.
struct Distances
{
    float of_proxy = 0; ///< no point of the proxy is farther from the mesh
    float of_mesh = 0;  ///< no point of the mesh is farther from the proxy
};

/// Bound the distances of two surfaces, with at least one triangle each: each is at most 1.1 times the
/// true one, or `enough` of the mesh's diagonal. Surfaces that are apart everywhere take time with the
/// inverse square of it.
Distances boundDistances(const Surface& mesh, const Surface& proxy, double enough);

/// Bounds the distances of many meshes and their proxies: those of equal surfaces once.
class SharedDistances
{
public:
    /// enough  as above
    explicit SharedDistances(double enough) : enough_(enough) {}

    /// Bound the distances of two surfaces as boundDistances.
    Distances bound(const Surface& mesh, const Surface& proxy);

private:
    double enough_;
    std::map<std::array<SurfaceHash, 2>, Distances> distances_;
};

} // namespace hearth::proxy
