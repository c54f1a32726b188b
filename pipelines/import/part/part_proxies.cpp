// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/part/part_proxies.h"

#include "cook/proxy/surface/convex.h"
#include "formats/base/index.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace hearth::import
{

using proxy::ConvexFault;
using proxy::MadeProxy;
using proxy::Surface;

namespace
{

Surface toSurface(const mesh::SourceMesh& mesh)
{
    Surface surface{mesh.positions, mesh.indices, mesh.triangle_materials};
    surface.materials.resize(mesh.triangleCount(), kInvalidIndex);
    return surface;
}

/// Append the triangles and positions of a surface.
void appendSurface(Surface& to, const Surface& from)
{
    const auto first = static_cast<uint32_t>(to.positions.size());
    to.positions.insert(to.positions.end(), from.positions.begin(), from.positions.end());
    for (const uint32_t index : from.indices)
        to.indices.push_back(first + index);
    to.materials.insert(to.materials.end(), from.materials.begin(), from.materials.end());
}

std::string describeFault(ConvexFault fault)
{
    switch (fault)
    {
    case ConvexFault::none:
        break;
    case ConvexFault::too_large:
        return fmt::format("has more than {} vertices: make it simpler", proxy::kMaxConvexPositions);
    case ConvexFault::open:
        return "is not closed: fill its holes";
    case ConvexFault::inside_out:
        return "faces inwards, or is flat: turn its triangles over";
    case ConvexFault::dented:
        return "has dents: split it into convex parts";
    }
    return {};
}

/// Make the proxy of all pieces that need not be convex; without triangles if there are none.
MadeProxy makeProxy(std::span<const ProxyPiece> pieces)
{
    MadeProxy made;
    for (const ProxyPiece& piece : pieces)
        if (!piece.is_convex)
            appendSurface(made.surface, toSurface(piece.mesh));
    weldByPosition(made.surface);
    sortByMaterial(made.surface);
    made.sections = makeMaterialSections(made.surface);
    made.is_closed = isClosed(made.surface);
    return made;
}

/// Make the proxy of all convex pieces; without triangles if there are none.
MadeProxy makeConvexProxy(std::span<const ProxyPiece> pieces, PartBuilder& part)
{
    MadeProxy made;
    made.is_closed = true;
    for (const ProxyPiece& piece : pieces)
    {
        if (!piece.is_convex)
            continue;
        Surface solid = toSurface(piece.mesh);
        weldByPosition(solid);
        sortByMaterial(solid);
        if (solid.triangleCount() == 0)
            continue;
        const ConvexFault fault = findConvexFault(solid);
        if (fault != ConvexFault::none)
            part.warn(Issue::degraded, piece.where,
                      fmt::format("the convex part \"{}\" of a proxy {}; until then it is a part that is not "
                                  "convex",
                                  piece.mesh.name, describeFault(fault)));
        made.is_closed = made.is_closed && isClosed(solid);
        const auto first = static_cast<uint32_t>(made.surface.triangleCount());
        const auto count = static_cast<uint32_t>(solid.triangleCount());
        const uint32_t material =
            solid.materials.front() == solid.materials.back() ? solid.materials.front() : kInvalidIndex;
        made.sections.push_back({{first, count}, material, fault == ConvexFault::none ? 1u : 0u});
        appendSurface(made.surface, solid);
    }
    return made;
}

} // namespace

ProxyPiece matchMaterials(std::span<const std::string_view> names, FileProxyPiece piece)
{
    std::vector<uint32_t> number_of_material;
    for (const std::string& name : piece.material_names)
    {
        const auto found = std::ranges::find(names, name);
        number_of_material.push_back(found == names.end() ? kInvalidIndex
                                                          : static_cast<uint32_t>(found - names.begin()));
    }
    for (uint32_t& material : piece.mesh.triangle_materials)
        material = material == kInvalidIndex ? kInvalidIndex : number_of_material[material];
    return std::move(piece);
}

Error findNoMeshError(const FileProxies& proxies, std::span<const std::string> names)
{
    constexpr size_t kMaxListed = 8;
    std::string list;
    for (const std::string& name : names.first(std::min(names.size(), kMaxListed)))
        list += (list.empty() ? "" : ", ") + name;
    if (names.size() > kMaxListed)
        list += ", ...";
    return {Issue::usage, "--proxy " + proxies.word, "",
            fmt::format("{}: write --proxy MESH=FILE with one of {} names: {}",
                        proxies.mesh.empty()
                            ? std::string("which mesh it is for is not said, and the source has not just one")
                            : fmt::format("the source draws no mesh \"{}\"", proxies.mesh),
                        names.size(), list.empty() ? "none" : list)};
}

void addProxies(uint32_t mesh, const mesh::SourceMesh& of, std::span<const ProxyPiece> pieces,
                PartBuilder& part)
{
    Surface surface = toSurface(of);
    weldByPosition(surface);
    if (surface.triangleCount() == 0)
        return;
    for (MadeProxy& made : std::array{makeProxy(pieces), makeConvexProxy(pieces, part)})
    {
        if (made.surface.triangleCount() == 0)
            continue;
        made.origin = formats::ProxyOrigin::authored;
        made.distances = part.proxy_distances.bound(surface, made.surface);
        part.proxies.add(mesh, made);
    }
}

} // namespace hearth::import
