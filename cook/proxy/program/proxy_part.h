// Writes the proxy part: a proxy for each mesh of a source.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/proxy/clean/clean.h"
#include "cook/proxy/convex/decompose.h"
#include "formats/pack/pack_view.h"

#include <optional>
#include <string>
#include <vector>

namespace hearth::proxy
{

struct ProxySettings
{
    /// Error of the cut that a proxy is made from, over the diagonal of the mesh's box.
    double error = 0.002;
    /// Maximum triangles of that cut; a coarser cut is taken where it would have more.
    uint64_t triangles = UINT64_MAX;
    /// Maximum length of a hole's boundary that is filled, over the diagonal.
    double hole_length = CleanSettings{}.hole_length;
    bool binds_vertices = false;
    /// Convex parts that take the place of the triangles; nothing: the triangles stay.
    std::optional<ConvexSettings> convex;
    /// Make proxies of the meshes for which no artist made one.
    bool makes_missing = true;
};

/// Statistics of one proxy, or of a mesh without one, for the report.
struct MeshStatistics
{
    uint32_t mesh = 0;
    std::string name;
    formats::ProxyOrigin origin = formats::ProxyOrigin::cleaned;
    uint64_t mesh_triangles = 0;
    uint32_t triangles = 0; ///< 0: the mesh has no proxy
    uint32_t vertices = 0;
    uint32_t convex_parts = 0; ///< sections that are one
    bool is_closed = false;
    float distance = 0;      ///< as ProxyRecord::distance
    float mesh_distance = 0; ///< as ProxyRecord::mesh_distance
    uint64_t bytes = 0;      ///< not compressed
    CleanStatistics clean;   ///< of proxies that are cleaned
};

/// Write proxies of all meshes with area: those that the import part has, for an artist made them, else one
/// that is made here, once for meshes of the same shape. The result depends neither on the number of threads
/// nor, on processors of one class, on the machine.
///
/// import_part    meshes as they were imported
/// clusters_part  of the same source
/// wrap_part      closed surfaces around the meshes, which become their proxies; null: proxies are cleaned
///                cuts
/// errors: container_kind; those of checkHierarchy and checkProxies; meaning_reference where the parts are
/// of different sources; cannot_write
Result<std::vector<MeshStatistics>> writeProxyPart(const formats::PackView& import_part,
                                                   const formats::PackView& clusters_part,
                                                   const formats::PackView* wrap_part,
                                                   const std::string& output_path,
                                                   const ProxySettings& settings);

/// Return the statistics of all meshes as JSON text.
std::string statisticsJson(const std::string& source, const std::vector<MeshStatistics>& meshes);

} // namespace hearth::proxy
