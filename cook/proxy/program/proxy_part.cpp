// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/proxy/program/proxy_part.h"

#include "cook/json/json.h"
#include "cook/mesh/source_mesh.h"
#include "cook/mesh/weld.h"
#include "cook/proxy/surface/cut.h"
#include "cook/proxy/surface/proxy_tables.h"
#include "formats/base/rounding.h"
#include "formats/container/container_writer.h"
#include "formats/pack/pack_check.h"

#include <algorithm>
#include <optional>

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

/// Proxies of one mesh, and the statistics of each.
struct ProxiesOfMesh
{
    std::vector<MadeProxy> made;
    std::vector<MeshStatistics> statistics;
};

/// Copy a proxy of a part.
MadeProxy readProxy(const PackView& part, const ProxyRecord& record)
{
    const auto copy = [](auto records) { return std::vector(records.begin(), records.end()); };
    MadeProxy made;
    made.origin = static_cast<ProxyOrigin>(record.origin);
    made.is_closed = record.is_closed != 0;
    made.distances = {record.distance, record.mesh_distance};
    made.sections = copy(recordsInRange(part.proxySections(), record.sections));
    made.surface.positions = copy(recordsInRange(part.proxyPositions(), record.positions));
    made.surface.indices = copy(recordsInRange(part.proxyIndices(), record.indices));
    for (const ProxySectionRecord& section : made.sections)
        made.surface.materials.resize(section.triangles.first + section.triangles.count, section.material);
    return made;
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

/// Makes the proxies of a source, and takes those of its artist.
class ProxyMaker
{
public:
    ProxyMaker(const PackView& import_part, const PackView& clusters_part, const PackView* wrap_part,
               const ProxySettings& settings)
        : import_(import_part), clusters_(clusters_part), wrap_(wrap_part), settings_(settings)
    {
    }

    /// Take the proxies that an artist made for a mesh, or make one; none if the mesh has no area.
    Result<ProxiesOfMesh> make(uint32_t mesh) const
    {
        ProxiesOfMesh result;
        const MeshRecord& record = clusters_.meshes()[mesh];
        if (record.levels.count != 0)
        {
            const auto authored = std::ranges::equal_range(import_.proxies(), mesh, {}, &ProxyRecord::mesh);
            for (const ProxyRecord& proxy : authored)
                result.made.push_back(readProxy(import_, proxy));
            if (authored.empty() && settings_.makes_missing)
            {
                HEARTH_ASSIGN_OR_RETURN(MadeProxy made, makeOne(mesh, result.statistics.emplace_back()));
                result.made.push_back(std::move(made));
            }
        }
        result.statistics.resize(std::max<size_t>(result.made.size(), 1));
        for (MeshStatistics& statistics : result.statistics)
        {
            statistics.mesh = mesh;
            statistics.name = std::string(clusters_.text(record.name));
            if (record.levels.count != 0)
                statistics.mesh_triangles = clusters_.levels()[record.levels.first].triangle_count;
        }
        for (size_t i = 0; i < result.made.size(); ++i)
            HEARTH_TRY(finish(mesh, result.made[i], result.statistics[i]));
        return result;
    }

private:
    float findError(uint32_t mesh) const
    {
        const MeshRecord& record = clusters_.meshes()[mesh];
        const auto error =
            static_cast<float>(settings_.error * double{length(record.box_max - record.box_min)});
        return findCutError(clusters_, mesh, error, settings_.triangles);
    }

    /// Make a proxy of a mesh; without triangles if nothing is left of it.
    Result<MadeProxy> makeOne(uint32_t mesh, MeshStatistics& statistics) const
    {
        MadeProxy made;
        if (wrap_ != nullptr)
        {
            made.origin = ProxyOrigin::wrapped;
            HEARTH_ASSIGN_OR_RETURN(made.surface, readSurface(*wrap_, mesh));
        }
        else
        {
            HEARTH_ASSIGN_OR_RETURN(made.surface, readCut(clusters_, mesh, findError(mesh)));
            statistics.clean = cleanSurface(made.surface, {.hole_length = settings_.hole_length});
        }
        if (made.surface.triangleCount() == 0)
            return made;
        HEARTH_ASSIGN_OR_RETURN(const Surface source, readSurface(import_, mesh));
        made.distances =
            boundDistances(source, made.surface, wrap_ != nullptr ? kEnoughWrapped : kEnoughCleaned);
        if (settings_.convex)
            replaceByConvexParts(made);
        else
        {
            sortByMaterial(made.surface);
            made.sections = makeMaterialSections(made.surface);
            made.is_closed = isClosed(made.surface);
        }
        return made;
    }

    void replaceByConvexParts(MadeProxy& made) const
    {
        const Solid solid(made.surface);
        ConvexParts parts = decompose(solid, *settings_.convex);
        made.distances = {roundUp(double{made.distances.of_proxy} + parts.distance),
                          roundUp(double{made.distances.of_mesh} + parts.surface_distance)};
        uint32_t first = 0;
        for (const uint32_t end : parts.ends)
        {
            made.sections.push_back({{first, end - first}, parts.surface.materials[first], 1});
            first = end;
        }
        made.surface = std::move(parts.surface);
        made.is_closed = true;
    }

    /// Bind the vertices of the mesh's first level where asked for, and complete the statistics.
    Status finish(uint32_t mesh, MadeProxy& made, MeshStatistics& statistics) const
    {
        statistics.origin = made.origin;
        statistics.triangles = static_cast<uint32_t>(made.surface.triangleCount());
        statistics.vertices = static_cast<uint32_t>(made.surface.positions.size());
        statistics.convex_parts =
            static_cast<uint32_t>(std::ranges::count(made.sections, 1u, &ProxySectionRecord::is_convex));
        statistics.is_closed = made.is_closed;
        statistics.distance = made.distances.of_proxy;
        statistics.mesh_distance = made.distances.of_mesh;
        if (!settings_.binds_vertices || made.surface.triangleCount() == 0)
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

Status writeTables(const std::string& path, const ProxyTables& tables)
{
    HEARTH_ASSIGN_OR_RETURN(ContainerWriter writer, ContainerWriter::create(path, ContainerKind::part));
    HEARTH_TRY(tables.write(writer));
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
    HEARTH_TRY(checkProxies(import_part));
    if (wrap_part != nullptr)
        HEARTH_TRY(checkMeshes(*wrap_part, mesh_count));
    const ProxyMaker maker(import_part, clusters_part, wrap_part, settings);
    std::vector<std::optional<Result<ProxiesOfMesh>>> made(mesh_count);
    tbb::parallel_for(0u, mesh_count, [&](uint32_t mesh) { made[mesh].emplace(maker.make(mesh)); });
    ProxyTables tables;
    std::vector<MeshStatistics> statistics;
    for (uint32_t mesh = 0; mesh < mesh_count; ++mesh)
    {
        HEARTH_ASSIGN_OR_RETURN(ProxiesOfMesh proxies, std::move(*made[mesh]));
        for (size_t i = 0; i < proxies.made.size(); ++i)
        {
            if (proxies.made[i].surface.triangleCount() == 0)
                continue;
            tables.add(mesh, proxies.made[i]);
            proxies.statistics[i].bytes = countBytes(tables.proxies.back());
        }
        statistics.insert(statistics.end(), proxies.statistics.begin(), proxies.statistics.end());
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
                        {"bytes", mesh.bytes},
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
