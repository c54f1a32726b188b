// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/proxies/proxy_check.h"

#include "cook/tools/open_part.h"
#include "formats/base/double3.h"
#include "tests/support/proxies/manifold.h"

#include <algorithm>
#include <cmath>

namespace hearth::test
{

using namespace formats;

namespace
{

/// Positions of a mesh's first level, cluster by cluster.
Result<std::vector<Float3>> readFirstLevel(const PackView& part, const MeshRecord& mesh)
{
    std::vector<Float3> positions;
    std::vector<std::byte> bytes;
    uint32_t page = kInvalidIndex;
    for (const ClusterRecord& cluster :
         recordsInRange(part.clusters(), part.levels()[mesh.levels.first].clusters))
    {
        if (page != cluster.page)
        {
            HEARTH_ASSIGN_OR_RETURN(bytes, part.decodePage(cluster.page));
            page = cluster.page;
        }
        const std::optional<ClusterGeometry> geometry = ClusterGeometry::at(bytes, cluster, mesh);
        if (!geometry)
            return Error{Issue::meaning_geometry, part.name(), "", "a cluster lies outside its page"};
        for (uint32_t v = 0; v < geometry->vertexCount(); ++v)
            positions.push_back(geometry->position(v));
    }
    return positions;
}

/// Return the place of a binding, and by how much the rounding of its weights may move it.
std::pair<Double3, double> findPlace(const TriangleSurface& surface, const ProxyBindingRecord& binding)
{
    const auto corner = [&](size_t k)
    { return widen(surface.positions[surface.triangles[size_t{binding.triangle} * 3 + k]]); };
    const Double3 a = corner(0), ab = corner(1) - a, ac = corner(2) - a;
    return {a + ab * (binding.weights[0] / 65535.0) + ac * (binding.weights[1] / 65535.0),
            (length(ab) + length(ac)) / 65535};
}

} // namespace

Result<ProxyParts> openProxyParts(const std::string& name)
{
    HEARTH_ASSIGN_OR_RETURN(PackView import_part, tools::openPart(name + ".import.part"));
    HEARTH_ASSIGN_OR_RETURN(PackView clusters_part, tools::openPart(name + ".clusters.part"));
    HEARTH_ASSIGN_OR_RETURN(PackView proxy_part, tools::openPart(name + ".proxy.part"));
    return ProxyParts{std::move(import_part), std::move(clusters_part), std::move(proxy_part)};
}

double CheckedProxy::diagonal() const
{
    Float3 low = mesh.positions[mesh.indices.front()], high = low;
    for (const uint32_t vertex : mesh.indices)
    {
        low = min(low, mesh.positions[vertex]);
        high = max(high, mesh.positions[vertex]);
    }
    return length(widen(high) - widen(low));
}

double CheckedProxy::rounding() const
{
    double size = 0;
    for (const Float3 position : mesh.positions)
        size = std::max(size, length(widen(position)));
    return 4e-7 * size;
}

Result<CheckedProxy> readProxy(const ProxyParts& parts, size_t proxy)
{
    const PackView& part = parts.proxy_part;
    CheckedProxy read{.record = part.proxies()[proxy]};
    read.surface = {recordsInRange(part.proxyPositions(), read.record.positions),
                    recordsInRange(part.proxyIndices(), read.record.indices)};
    read.bindings = recordsInRange(part.proxyBindings(), read.record.bindings);
    HEARTH_ASSIGN_OR_RETURN(read.mesh, mesh::readSourceMesh(parts.import_part.container(), read.record.mesh));
    return read;
}

std::string findShapeDefect(const CheckedProxy& proxy)
{
    const auto& [positions, triangles] = proxy.surface;
    if (std::any_of(triangles.begin(), triangles.end(), [&](uint32_t v) { return v >= positions.size(); }))
        return "an index has no position";
    if (std::string defect = findManifoldDefect(positions.size(), triangles); !defect.empty())
        return defect;
    const size_t open = countOpenEdges(triangles);
    if ((open == 0) != (proxy.record.is_closed != 0))
        return std::to_string(open) + " open edges, and stored as " +
               (proxy.record.is_closed != 0 ? "closed" : "open");
    return "";
}

Result<std::string> findBindingDefect(const ProxyParts& parts, const CheckedProxy& proxy)
{
    const MeshRecord& mesh = parts.clusters_part.meshes()[proxy.record.mesh];
    HEARTH_ASSIGN_OR_RETURN(const std::vector<Float3> vertices, readFirstLevel(parts.clusters_part, mesh));
    if (proxy.bindings.size() != vertices.size())
        return std::to_string(proxy.bindings.size()) + " bindings of " + std::to_string(vertices.size()) +
               " vertices";
    const SurfaceDistance nearest(proxy.surface.positions, proxy.surface.triangles);
    const double rounding = proxy.rounding();
    for (size_t v = 0; v < vertices.size(); ++v)
    {
        const ProxyBindingRecord& binding = proxy.bindings[v];
        const std::string name = "the binding of vertex " + std::to_string(v);
        if (binding.triangle >= proxy.surface.triangles.size() / 3)
            return name + " has no triangle";
        if (binding.weights[0] + binding.weights[1] > 65535)
            return name + " is off its triangle";
        const auto [place, step] = findPlace(proxy.surface, binding);
        const double distance = length(place - widen(vertices[v])), stated = double{binding.distance};
        if (std::abs(distance - stated) > step + rounding)
            return name + " is at " + std::to_string(distance) + " m, and stored as " +
                   std::to_string(stated);
        if (stated > 8 * nearest.to(vertices[v]) + rounding)
            return name + " is more than eight times as far as the nearest point";
    }
    return std::string();
}

} // namespace hearth::test
