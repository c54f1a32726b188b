// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/frame/proxy_casters.h"

#include "formats/scene/lit_material.h"

#include <algorithm>
#include <cmath>

namespace hearth::shared
{

namespace
{

bool isSolid(const formats::PackView& pack, uint32_t material)
{
    if (material == kInvalidIndex)
        return true;
    const formats::MaterialRecord& record = pack.materials()[material];
    return record.alpha_mode == static_cast<uint32_t>(formats::AlphaMode::opaque) && formats::isLit(record);
}

bool isSolidMesh(const formats::PackView& pack, uint32_t mesh)
{
    return std::ranges::all_of(formats::recordsInRange(pack.clusters(), pack.meshes()[mesh].clusters),
                               [&](const formats::ClusterRecord& cluster)
                               { return isSolid(pack, cluster.material); });
}

bool isDeformed(const formats::PackView& pack, uint32_t mesh)
{
    return std::ranges::any_of(pack.deformedMeshes(), [&](const formats::DeformedMeshRecord& deformed)
                               { return deformed.mesh == mesh; });
}

} // namespace

ProxyCasters findProxyCasters(const formats::PackView& pack)
{
    ProxyCasters casters{std::vector<ProxyCaster>(pack.meshes().size()),
                         std::vector<Box3>(pack.meshes().size())};
    std::vector<uint32_t> proxy_counts(pack.meshes().size(), 0);
    for (const formats::ProxyRecord& proxy : pack.proxies())
        ++proxy_counts[proxy.mesh];
    for (const formats::ProxyRecord& proxy : pack.proxies())
    {
        // A gap between a surface and a proxy in front of it is no wider than either: a proxy of a hollow
        // body is far from what is inside, and one that closes a hole is far from all of it.
        const float gap = std::min(proxy.distance, proxy.mesh_distance);
        // Light that grazes a ball of radius R enters a shell at distance d around it through a plane that
        // lies (2 R + d) / (R + d) d before the point that it grazes, which is less than 2 d.
        const float distance = 2 * gap;
        if (proxy_counts[proxy.mesh] > 1 || !std::isfinite(distance) || isDeformed(pack, proxy.mesh) ||
            !isSolidMesh(pack, proxy.mesh))
            continue;
        casters.rows[proxy.mesh] = {.first_position = proxy.positions.first,
                                    .first_index = proxy.indices.first,
                                    .triangle_count = proxy.indices.count / 3,
                                    .is_closed = proxy.is_closed,
                                    .distance = distance,
                                    .reserved0 = 0,
                                    .reserved1 = 0,
                                    .reserved2 = 0};
        for (const Float3 position : formats::recordsInRange(pack.proxyPositions(), proxy.positions))
            casters.boxes[proxy.mesh].add(position);
    }
    return casters;
}

} // namespace hearth::shared
