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
#include <array>
#include <map>
#include <numeric>
#include <optional>
#include <ranges>

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

/// Hashes of all that a proxy is made of: the surface that becomes it, and the one to which its distances are
/// bounded.
using SourceHash = std::array<SurfaceHash, 2>;

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

    /// Find for each mesh the first one that has the same proxy: itself, or an earlier one of the same shape.
    Result<std::vector<uint32_t>> findFirstOfShape() const
    {
        const auto mesh_count = static_cast<uint32_t>(clusters_.meshes().size());
        // only meshes with the same counts are read and compared
        std::map<std::array<uint32_t, 3>, std::vector<uint32_t>> alike;
        for (uint32_t mesh = 0; mesh < mesh_count; ++mesh)
        {
            const MeshRecord& record = clusters_.meshes()[mesh];
            if (needsProxy(mesh))
                alike[{record.source_triangles, record.source_vertices, record.clusters.count}].push_back(
                    mesh);
        }
        std::vector<uint32_t> first_of_shape(mesh_count);
        std::iota(first_of_shape.begin(), first_of_shape.end(), 0u);
        for (const auto& [counts, meshes] : alike)
        {
            if (meshes.size() == 1)
                continue;
            std::vector<std::optional<Result<SourceHash>>> hashes(meshes.size());
            tbb::parallel_for(size_t{0}, meshes.size(),
                              [&](size_t i) { hashes[i].emplace(readHash(meshes[i])); });
            std::map<SourceHash, uint32_t> first_of_hash;
            for (size_t i = 0; i < meshes.size(); ++i)
            {
                HEARTH_ASSIGN_OR_RETURN(const SourceHash hash, *hashes[i]);
                first_of_shape[meshes[i]] = first_of_hash.emplace(hash, meshes[i]).first->second;
            }
        }
        return first_of_shape;
    }

    /// Take the proxies that an artist made for a mesh, or make one; none if the mesh has no area.
    Result<ProxiesOfMesh> make(uint32_t mesh) const
    {
        ProxiesOfMesh result;
        if (needsProxy(mesh))
        {
            HEARTH_ASSIGN_OR_RETURN(MadeProxy made, makeOne(mesh, result.statistics.emplace_back()));
            result.made.push_back(std::move(made));
        }
        else if (clusters_.meshes()[mesh].levels.count != 0)
            for (const ProxyRecord& proxy : findAuthored(mesh))
                result.made.push_back(readProxy(import_, proxy));
        return complete(mesh, std::move(result));
    }

    /// Complete the proxies of a mesh.
    /// result  made for it, or for another one of the same shape
    Result<ProxiesOfMesh> complete(uint32_t mesh, ProxiesOfMesh result) const
    {
        const MeshRecord& record = clusters_.meshes()[mesh];
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
    std::ranges::subrange<std::span<const ProxyRecord>::iterator> findAuthored(uint32_t mesh) const
    {
        return std::ranges::equal_range(import_.proxies(), mesh, {}, &ProxyRecord::mesh);
    }

    /// True if a proxy is made here: the mesh has an area, and no artist made one.
    bool needsProxy(uint32_t mesh) const
    {
        return settings_.makes_missing && clusters_.meshes()[mesh].levels.count != 0 &&
               findAuthored(mesh).empty();
    }

    /// Read the surface that becomes the proxy of a mesh: its wrap, or a cut.
    Result<Surface> readBase(uint32_t mesh) const
    {
        return wrap_ != nullptr ? readSurface(*wrap_, mesh) : readCut(clusters_, mesh, findError(mesh));
    }

    Result<SourceHash> readHash(uint32_t mesh) const
    {
        HEARTH_ASSIGN_OR_RETURN(const Surface base, readBase(mesh));
        HEARTH_ASSIGN_OR_RETURN(const Surface source, readSurface(import_, mesh));
        return SourceHash{hashSurface(base), hashSurface(source)};
    }

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
        HEARTH_ASSIGN_OR_RETURN(made.surface, readBase(mesh));
        if (wrap_ != nullptr)
            made.origin = ProxyOrigin::wrapped;
        else
            statistics.clean = cleanSurface(made.surface, {.hole_length = settings_.hole_length});
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
    HEARTH_ASSIGN_OR_RETURN(const std::vector<uint32_t> first_of_shape, maker.findFirstOfShape());
    std::vector<std::optional<Result<ProxiesOfMesh>>> made(mesh_count);
    tbb::parallel_for(0u, mesh_count,
                      [&](uint32_t mesh)
                      {
                          if (first_of_shape[mesh] == mesh)
                              made[mesh].emplace(maker.make(mesh));
                      });
    tbb::parallel_for(0u, mesh_count,
                      [&](uint32_t mesh)
                      {
                          const Result<ProxiesOfMesh>& first = *made[first_of_shape[mesh]];
                          if (first_of_shape[mesh] != mesh)
                              made[mesh].emplace(first.ok() ? maker.complete(mesh, first.value()) : first);
                      });
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
