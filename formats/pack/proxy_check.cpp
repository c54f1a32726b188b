// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/pack/check_tools.h"

namespace hearth::formats::check
{

namespace
{

constexpr const char* kProxyKind = "proxy";

/// Check that the sections of a proxy hold all its triangles, one after another.
Status checkSections(const PackView& view, size_t proxy_index)
{
    const ProxyRecord& proxy = view.proxies()[proxy_index];
    uint32_t triangles = 0;
    for (const ProxySectionRecord& section : recordsInRange(view.proxySections(), proxy.sections))
    {
        const auto wrong = [&](Issue issue, std::string detail)
        { return makeError(view, issue, kProxyKind, proxy_index, std::move(detail)); };
        if (section.triangles.first != triangles || section.triangles.count == 0 ||
            section.triangles.count > proxy.indices.count / 3 - triangles)
            return wrong(Issue::meaning_range, "its sections do not share out its triangles in order");
        if (section.is_convex > 1)
            return wrong(Issue::meaning_value, "a section is neither convex nor not");
        triangles += section.triangles.count;
    }
    if (triangles != proxy.indices.count / 3)
        return makeError(view, Issue::meaning_range, kProxyKind, proxy_index,
                         "its last triangles belong to no section");
    return success();
}

Status checkBindings(const PackView& view, size_t proxy_index)
{
    const ProxyRecord& proxy = view.proxies()[proxy_index];
    for (const ProxyBindingRecord& binding : recordsInRange(view.proxyBindings(), proxy.bindings))
    {
        if (binding.triangle >= proxy.indices.count / 3)
            return makeError(view, Issue::meaning_reference, kProxyKind, proxy_index,
                             "a binding is to triangle " + std::to_string(binding.triangle));
        if (uint32_t{binding.weights[0]} + binding.weights[1] > 65535 || !isNonNegative(binding.distance))
            return makeError(view, Issue::meaning_value, kProxyKind, proxy_index,
                             "a binding has weights or a distance that cannot be");
    }
    return success();
}

Status checkProxy(const PackView& view, size_t index)
{
    const ProxyRecord& proxy = view.proxies()[index];
    const auto wrong = [&](Issue issue, std::string detail)
    { return makeError(view, issue, kProxyKind, index, std::move(detail)); };
    if (proxy.origin >= kProxyOriginNames.size())
        return wrong(Issue::meaning_value, "origin " + std::to_string(proxy.origin));
    if (proxy.is_closed > 1)
        return wrong(Issue::meaning_value, "it is neither closed nor open");
    if (!(proxy.distance >= 0) || !(proxy.mesh_distance >= 0))
        return wrong(Issue::meaning_value, "a distance is negative or not a number");
    if (!reservedZero(proxy.reserved))
        return wrong(Issue::meaning_padding, "a reserved field is not 0");
    if (proxy.indices.count == 0 || proxy.indices.count % 3 != 0)
        return wrong(Issue::meaning_range, std::to_string(proxy.indices.count) + " indices");
    for (const Float3 position : recordsInRange(view.proxyPositions(), proxy.positions))
        if (!finite(position))
            return wrong(Issue::meaning_value, "a position is not finite");
    for (const uint32_t vertex : recordsInRange(view.proxyIndices(), proxy.indices))
        if (vertex >= proxy.positions.count)
            return wrong(Issue::meaning_reference, "an index is to position " + std::to_string(vertex));
    HEARTH_TRY(checkSections(view, index));
    return checkBindings(view, index);
}

/// Count the vertices of a mesh's first level.
uint64_t countFinestVertices(const PackView& view, const MeshRecord& mesh)
{
    uint64_t count = 0;
    if (mesh.levels.count != 0)
        for (const ClusterRecord& cluster :
             recordsInRange(view.clusters(), view.levels()[mesh.levels.first].clusters))
            count += cluster.vertex_count;
    return count;
}

} // namespace

Status checkProxyTables(const PackView& view)
{
    RangeCursor positions(view, kProxyKind, "proxy position", view.proxyPositions().size());
    RangeCursor indices(view, kProxyKind, "proxy index", view.proxyIndices().size());
    RangeCursor sections(view, kProxyKind, "proxy section", view.proxySections().size());
    RangeCursor bindings(view, kProxyKind, "proxy binding", view.proxyBindings().size());
    const std::span<const ProxyRecord> proxies = view.proxies();
    for (size_t i = 0; i < proxies.size(); ++i)
    {
        if (i > 0 && proxies[i].mesh < proxies[i - 1].mesh)
            return makeError(view, Issue::meaning_order, kProxyKind, i,
                             "its mesh is before that of the last");
        HEARTH_TRY(positions.take(i, proxies[i].positions));
        HEARTH_TRY(indices.take(i, proxies[i].indices));
        HEARTH_TRY(sections.take(i, proxies[i].sections));
        HEARTH_TRY(bindings.take(i, proxies[i].bindings));
        HEARTH_TRY(checkProxy(view, i));
    }
    HEARTH_TRY(positions.finish());
    HEARTH_TRY(indices.finish());
    HEARTH_TRY(sections.finish());
    return bindings.finish();
}

Status checkProxyReferences(const PackView& view)
{
    for (size_t i = 0; i < view.proxies().size(); ++i)
    {
        const ProxyRecord& proxy = view.proxies()[i];
        if (proxy.mesh >= view.meshes().size())
            return makeError(view, Issue::meaning_reference, kProxyKind, i,
                             "mesh " + std::to_string(proxy.mesh));
        if (proxy.bindings.count != 0 &&
            proxy.bindings.count != countFinestVertices(view, view.meshes()[proxy.mesh]))
            return makeError(view, Issue::meaning_range, kProxyKind, i,
                             "it has not a binding for each vertex of its mesh");
        for (const ProxySectionRecord& section : recordsInRange(view.proxySections(), proxy.sections))
            if (!isNoneOrBelow(section.material, view.materials().size()))
                return makeError(view, Issue::meaning_reference, kProxyKind, i,
                                 "material " + std::to_string(section.material));
    }
    return success();
}

} // namespace hearth::formats::check
