// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/proxy/surface/surface.h"

#include "cook/mesh/triangles.h"
#include "cook/mesh/weld.h"
#include "formats/container/container_reader.h"

#include <span>
#include <utility>

namespace hearth::proxy
{

SurfaceHash hashSurface(const Surface& surface)
{
    const auto hash = [](const auto& values) { return formats::hashBytes(std::as_bytes(std::span(values))); };
    return {hash(surface.positions), hash(surface.indices), hash(surface.materials)};
}

float findDiagonal(const Surface& surface)
{
    Box3 box;
    for (const Float3 position : surface.positions)
        box.add(position);
    return box.empty() ? 0 : length(box.max - box.min);
}

void weldByPosition(Surface& surface)
{
    const mesh::Weld weld = mesh::weldPositions(surface.positions);
    std::vector<Float3> positions(weld.position_count);
    for (size_t v = 0; v < surface.positions.size(); ++v)
        positions[weld.position_id_of_vertex[v]] = surface.positions[v];
    Surface welded;
    for (size_t t = 0; t < surface.triangleCount(); ++t)
    {
        const auto corner = [&](size_t k) { return weld.position_id_of_vertex[surface.indices[3 * t + k]]; };
        if (!mesh::isDegenerate(positions[corner(0)], positions[corner(1)], positions[corner(2)]))
            welded.add({corner(0), corner(1), corner(2)}, surface.materials[t]);
    }
    welded.positions = std::move(positions);
    surface = std::move(welded);
}

} // namespace hearth::proxy
