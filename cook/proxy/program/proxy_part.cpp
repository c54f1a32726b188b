// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/proxy/program/proxy_part.h"

#include "cook/json/json.h"
#include "cook/mesh/source_mesh.h"
#include "cook/mesh/weld.h"
#include "cook/proxy/surface/binding.h"
#include "cook/proxy/surface/cut.h"
#include "formats/base/rounding.h"
#include "formats/container/container_writer.h"
#include "formats/pack/pack_check.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <tbb/parallel_for.h>

namespace hearth::proxy
{

using namespace formats;

namespace
{

// Shares of the diagonal below which distances need not be told apart. A cleaned proxy lies on its mesh
// for the most part, a wrap everywhere off it.
constexpr double kEnoughCleaned = 1e-4;
constexpr double kEnoughWrapped = 5e-3;

/// Proxy of one mesh.
struct MadeProxy
{
    Surface surface; ///< triangles with one material follow each other, or those of a convex part
    std::vector<uint32_t> part_ends; ///< of each convex part, if it has any: the triangle after its last one
    std::vector<ProxyBindingRecord> bindings;
    MeshStatistics statistics;
};

/// Tables of the part.
struct Tables
{
    std::vector<ProxyRecord> proxies;
    std::vector<ProxySectionRecord> sections;
    std::vector<Float3> positions;
    std::vector<uint32_t> indices;
    std::vector<ProxyBindingRecord> bindings;
};

/// True if each half-edge is joined with another one.
bool isClosed(const Surface& surface)
{
    const std::vector<uint32_t> joined = joinHalfEdges(surface);
    return std::ranges::none_of(joined, [](uint32_t other) { return other == kInvalidIndex; });
}

/// Bring triangles with one material together, those without one last.
void sortByMaterial(Surface& surface)
{
    std::vector<uint32_t> order(surface.triangleCount());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](uint32_t a, uint32_t b) { return surface.materials[a] < surface.materials[b]; });
    Surface sorted;
    for (const uint32_t t : order)
        sorted.add({surface.indices[3 * t], surface.indices[3 * t + 1], surface.indices[3 * t + 2]},
                   surface.materials[t]);
    surface.indices = std::move(sorted.indices);
    surface.materials = std::move(sorted.materials);
}

/// Read the mesh of a part that holds meshes as they are imported, welded by position.
Result<Surface> readSurface(const PackView& part, uint32_t mesh)
{
    HEARTH_ASSIGN_OR_RETURN(mesh::SourceMesh source, mesh::readSourceMesh(part.container(), mesh));
    Surface surface{std::move(source.positions), std::move(source.indices),
                    std::move(source.triangle_materials)};
    surface.materials.resize(surface.indices.size() / 3, kInvalidIndex);
    weldByPosition(surface);
    return surface;
}

/// Makes the proxies of a source.
class ProxyMaker
{
public:
    ProxyMaker(const PackView& import_part, const PackView& clusters_part, const PackView* wrap_part,
               const ProxySettings& settings)
        : import_(import_part), clusters_(clusters_part), wrap_(wrap_part), settings_(settings)
    {
    }

    /// Make the proxy of a mesh; without triangles if the mesh has no area.
    Result<MadeProxy> make(uint32_t mesh) const
    {
        MadeProxy made;
        MeshStatistics& statistics = made.statistics;
        statistics.mesh = mesh;
        statistics.name = std::string(clusters_.text(clusters_.meshes()[mesh].name));
        const MeshRecord& record = clusters_.meshes()[mesh];
        if (record.levels.count == 0)
            return made;
        statistics.mesh_triangles = clusters_.levels()[record.levels.first].triangle_count;
        if (wrap_ != nullptr)
        {
            statistics.origin = ProxyOrigin::wrapped;
            HEARTH_ASSIGN_OR_RETURN(made.surface, readSurface(*wrap_, mesh));
        }
        else
        {
            HEARTH_ASSIGN_OR_RETURN(made.surface, readCut(clusters_, mesh, findError(mesh)));
            statistics.clean = cleanSurface(made.surface, {.hole_length = settings_.hole_length});
        }
        if (made.surface.triangleCount() == 0)
            return made;
        if (settings_.convex)
            return makeConvex(mesh, std::move(made));
        sortByMaterial(made.surface);
        statistics.triangles = static_cast<uint32_t>(made.surface.triangleCount());
        statistics.vertices = static_cast<uint32_t>(made.surface.positions.size());
        statistics.is_closed = isClosed(made.surface);
        HEARTH_TRY(measure(mesh, made));
        HEARTH_TRY(bind(mesh, made));
        return made;
    }

private:
    /// Let convex parts take the place of a proxy's triangles.
    Result<MadeProxy> makeConvex(uint32_t mesh, MadeProxy made) const
    {
        HEARTH_TRY(measure(mesh, made));
        const Solid solid(made.surface);
        ConvexParts parts = decompose(solid, *settings_.convex);
        MeshStatistics& statistics = made.statistics;
        statistics.distance = roundUp(double{statistics.distance} + parts.distance);
        statistics.mesh_distance = roundUp(double{statistics.mesh_distance} + parts.surface_distance);
        statistics.triangles = static_cast<uint32_t>(parts.surface.triangleCount());
        statistics.vertices = static_cast<uint32_t>(parts.surface.positions.size());
        statistics.convex_parts = static_cast<uint32_t>(parts.ends.size());
        statistics.is_closed = true;
        made.surface = std::move(parts.surface);
        made.part_ends = std::move(parts.ends);
        HEARTH_TRY(bind(mesh, made));
        return made;
    }

    float findError(uint32_t mesh) const
    {
        const MeshRecord& record = clusters_.meshes()[mesh];
        const auto error =
            static_cast<float>(settings_.error * double{length(record.box_max - record.box_min)});
        return findCutError(clusters_, mesh, error, settings_.triangles);
    }

    /// Bound the distances to the mesh as it was imported.
    Status measure(uint32_t mesh, MadeProxy& made) const
    {
        HEARTH_ASSIGN_OR_RETURN(const Surface source, readSurface(import_, mesh));
        const Distances distances =
            boundDistances(source, made.surface, wrap_ != nullptr ? kEnoughWrapped : kEnoughCleaned);
        made.statistics.distance = distances.of_proxy;
        made.statistics.mesh_distance = distances.of_mesh;
        return success();
    }

    /// Bind the vertices of the mesh's first level, if that is asked for.
    Status bind(uint32_t mesh, MadeProxy& made) const
    {
        if (!settings_.binds_vertices)
            return success();
        HEARTH_ASSIGN_OR_RETURN(const FinestVertices vertices, readFinestVertices(clusters_, mesh));
        made.bindings = bindVertices(vertices, made.surface);
        return success();
    }

    const PackView& import_;
    const PackView& clusters_;
    const PackView* wrap_;
    const ProxySettings& settings_;
};

template <typename T>
Range append(std::vector<T>& table, const std::vector<T>& records)
{
    const Range range{static_cast<uint32_t>(table.size()), static_cast<uint32_t>(records.size())};
    table.insert(table.end(), records.begin(), records.end());
    return range;
}

/// Return a section for each convex part, else for each material, which triangles are sorted by.
std::vector<ProxySectionRecord> makeSections(const MadeProxy& made)
{
    std::vector<ProxySectionRecord> sections;
    const Surface& surface = made.surface;
    uint32_t first = 0;
    for (const uint32_t end : made.part_ends)
    {
        sections.push_back({{first, end - first}, surface.materials[first], 1});
        first = end;
    }
    if (!sections.empty())
        return sections;
    for (uint32_t t = 0; t < surface.triangleCount(); ++t)
        if (t > 0 && surface.materials[t] == surface.materials[t - 1])
            ++sections.back().triangles.count;
        else
            sections.push_back({{t, 1}, surface.materials[t], 0});
    return sections;
}

void addProxy(const MadeProxy& made, Tables& tables)
{
    const MeshStatistics& statistics = made.statistics;
    ProxyRecord record{};
    record.mesh = statistics.mesh;
    record.origin = static_cast<uint32_t>(statistics.origin);
    record.is_closed = statistics.is_closed ? 1 : 0;
    record.distance = statistics.distance;
    record.mesh_distance = statistics.mesh_distance;
    record.positions = append(tables.positions, made.surface.positions);
    record.indices = append(tables.indices, made.surface.indices);
    record.sections = append(tables.sections, makeSections(made));
    record.bindings = append(tables.bindings, made.bindings);
    tables.proxies.push_back(record);
}

Status writeTables(const std::string& path, const Tables& tables)
{
    HEARTH_ASSIGN_OR_RETURN(ContainerWriter writer, ContainerWriter::create(path, ContainerKind::part));
    HEARTH_TRY(writer.addRecords<ProxyRecord>(kChunkProxies, tables.proxies));
    HEARTH_TRY(writer.addRecords<ProxySectionRecord>(kChunkProxySections, tables.sections));
    HEARTH_TRY(writer.addRecords<Float3>(kChunkProxyPositions, tables.positions));
    HEARTH_TRY(writer.addRecords<uint32_t>(kChunkProxyIndices, tables.indices));
    HEARTH_TRY(writer.addRecords<ProxyBindingRecord>(kChunkProxyBindings, tables.bindings));
    return writer.finish();
}

/// Check that the parts are of one source, as far as the number of meshes tells.
Status checkMeshes(const PackView& part, uint32_t mesh_count)
{
    uint32_t meshes = 0;
    for (const ChunkEntry& entry : part.container().chunks())
        meshes += entry.type == kChunkSourceMesh ? 1 : 0;
    if (meshes == mesh_count)
        return success();
    return Error{Issue::meaning_reference, part.name(), "",
                 "has " + std::to_string(meshes) + " meshes, the clusters part has " +
                     std::to_string(mesh_count) + ": pass parts of one source"};
}

} // namespace

Result<std::vector<MeshStatistics>> writeProxyPart(const PackView& import_part, const PackView& clusters_part,
                                                   const PackView* wrap_part, const std::string& output_path,
                                                   const ProxySettings& settings)
{
    HEARTH_TRY(checkHierarchy(clusters_part));
    const auto mesh_count = static_cast<uint32_t>(clusters_part.meshes().size());
    HEARTH_TRY(checkMeshes(import_part, mesh_count));
    if (wrap_part != nullptr)
        HEARTH_TRY(checkMeshes(*wrap_part, mesh_count));
    const ProxyMaker maker(import_part, clusters_part, wrap_part, settings);
    std::vector<std::optional<Result<MadeProxy>>> made(mesh_count);
    tbb::parallel_for(0u, mesh_count, [&](uint32_t mesh) { made[mesh].emplace(maker.make(mesh)); });
    Tables tables;
    std::vector<MeshStatistics> statistics;
    for (std::optional<Result<MadeProxy>>& result : made)
    {
        HEARTH_ASSIGN_OR_RETURN(MadeProxy proxy, std::move(*result));
        if (proxy.surface.triangleCount() > 0)
            addProxy(proxy, tables);
        statistics.push_back(std::move(proxy.statistics));
    }
    HEARTH_TRY(writeTables(output_path, tables));
    return statistics;
}

std::string statisticsJson(const std::string& source, const std::vector<MeshStatistics>& meshes)
{
    Json list = Json::array();
    for (const MeshStatistics& mesh : meshes)
    {
        const CleanStatistics& clean = mesh.clean;
        list.push_back({{"mesh", mesh.mesh},
                        {"name", mesh.name},
                        {"origin", kProxyOriginNames[static_cast<size_t>(mesh.origin)]},
                        {"mesh_triangles", mesh.mesh_triangles},
                        {"triangles", mesh.triangles},
                        {"vertices", mesh.vertices},
                        {"convex_parts", mesh.convex_parts},
                        {"closed", mesh.is_closed},
                        {"distance", mesh.distance},
                        {"mesh_distance", mesh.mesh_distance},
                        {"doubled_triangles", clean.thin.duplicate},
                        {"thin_triangles", clean.thin.collapsed + clean.thin.flipped + clean.thin.dropped},
                        {"shells", clean.orientation.shells},
                        {"flipped_shells", clean.orientation.flipped_shells},
                        {"flipped_triangles", clean.orientation.flipped_triangles},
                        {"twisted_edges", clean.orientation.twisted_edges},
                        {"split_edges", clean.manifold.split_edges},
                        {"split_vertices", clean.manifold.split_vertices},
                        {"added_vertices", clean.manifold.added_vertices},
                        {"filled_holes", clean.holes.filled},
                        {"open_loops", clean.holes.open}});
    }
    const Json document{{"schema", "hearth.proxy/1"}, {"source", source}, {"meshes", list}};
    return document.dump(2) + "\n";
}

} // namespace hearth::proxy
