// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/proxy/surface/proxy_tables.h"

#include "cook/proxy/surface/half_edges.h"
#include "formats/base/assert.h"
#include "formats/base/index.h"

#include <algorithm>
#include <numeric>

namespace hearth::proxy
{

using namespace formats;

namespace
{

template <typename T>
Range append(std::vector<T>& table, const std::vector<T>& records)
{
    const Range range{static_cast<uint32_t>(table.size()), static_cast<uint32_t>(records.size())};
    table.insert(table.end(), records.begin(), records.end());
    return range;
}

} // namespace

bool isClosed(const Surface& surface)
{
    const std::vector<uint32_t> joined = joinHalfEdges(surface);
    return std::ranges::none_of(joined, [](uint32_t other) { return other == kInvalidIndex; });
}

void sortByMaterial(Surface& surface)
{
    std::vector<uint32_t> order(surface.triangleCount());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](uint32_t a, uint32_t b) { return surface.materials[a] < surface.materials[b]; });
    Surface sorted;
    std::vector<uint32_t> new_of_old(surface.positions.size(), kInvalidIndex);
    for (const uint32_t t : order)
    {
        std::array<uint32_t, 3> triangle{};
        for (size_t k = 0; k < 3; ++k)
        {
            uint32_t& position = new_of_old[surface.indices[3 * t + k]];
            if (position == kInvalidIndex)
            {
                position = static_cast<uint32_t>(sorted.positions.size());
                sorted.positions.push_back(surface.positions[surface.indices[3 * t + k]]);
            }
            triangle[k] = position;
        }
        sorted.add(triangle, surface.materials[t]);
    }
    surface = std::move(sorted);
}

std::vector<ProxySectionRecord> makeMaterialSections(const Surface& surface)
{
    std::vector<ProxySectionRecord> sections;
    for (uint32_t t = 0; t < surface.triangleCount(); ++t)
        if (t > 0 && surface.materials[t] == surface.materials[t - 1])
            ++sections.back().triangles.count;
        else
            sections.push_back({{t, 1}, surface.materials[t], 0});
    return sections;
}

uint64_t countBytes(const ProxyRecord& record)
{
    return sizeof(ProxyRecord) + uint64_t{record.positions.count} * sizeof(Float3) +
           uint64_t{record.indices.count} * sizeof(uint32_t) +
           uint64_t{record.sections.count} * sizeof(ProxySectionRecord) +
           uint64_t{record.bindings.count} * sizeof(ProxyBindingRecord);
}

void ProxyTables::add(uint32_t mesh, const MadeProxy& made)
{
    HEARTH_ASSERT(made.surface.triangleCount() > 0 && (proxies.empty() || proxies.back().mesh <= mesh));
    ProxyRecord record{};
    record.mesh = mesh;
    record.origin = static_cast<uint32_t>(made.origin);
    record.is_closed = made.is_closed ? 1 : 0;
    record.distance = made.distances.of_proxy;
    record.mesh_distance = made.distances.of_mesh;
    record.positions = append(positions, made.surface.positions);
    record.indices = append(indices, made.surface.indices);
    record.sections = append(sections, made.sections);
    record.bindings = append(bindings, made.bindings);
    proxies.push_back(record);
}

Status ProxyTables::write(ContainerWriter& writer) const
{
    HEARTH_TRY(writer.addRecords<ProxyRecord>(kChunkProxies, proxies));
    HEARTH_TRY(writer.addRecords<ProxySectionRecord>(kChunkProxySections, sections));
    HEARTH_TRY(writer.addRecords<Float3>(kChunkProxyPositions, positions));
    HEARTH_TRY(writer.addRecords<uint32_t>(kChunkProxyIndices, indices));
    return writer.addRecords<ProxyBindingRecord>(kChunkProxyBindings, bindings);
}

} // namespace hearth::proxy
