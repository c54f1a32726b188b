// Bakes visibility: reads an import part and its clusters part, and writes the clusters part with visibility
// at its vertices. See cook/visibility/README.md.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/program/baked_source.h"
#include "cook/visibility/program/instance_visibility.h"
#include "cook/visibility/program/mesh_fit.h"
#include "cook/visibility/program/sampling_plan.h"
#include "cook/visibility/rays/rays.h"
#include "cook/visibility/scene/poses.h"
#include "formats/pack/pack_view.h"

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hearth::visibility
{

/// Meshes that are in the way of rays.
enum class OccluderScope
{
    pack,   ///< all instances of the source's scene, and those of its neighbours
    source, ///< all instances of the source's scene
    mesh,   ///< the mesh itself, in its own space
};

/// Return the word for a scope in command lines and statistics.
std::string_view occluderScopeName(OccluderScope scope);

struct BakeSettings
{
    SamplingSettings sampling;
    RaySettings rays; ///< rays_per_sample is the plan's
    OccluderScope occluders = OccluderScope::pack;
    /// Bytes that copies of meshes may take, over those of the source's pages; 0: no copies.
    double copies = 0.25;
    MeshFitSettings fit;
    ProxyUse proxies = ProxyUse::none;
    std::vector<ClipTimes> poses; ///< deformed meshes get the mean over these; empty: the bind pose
};

/// Statistics of one baked mesh.
struct MeshStatistics
{
    uint32_t mesh = 0;
    std::string name;
    std::optional<uint32_t> copy_of; ///< mesh of the source, if this is a copy for one instance
    /// "rest"; for a deformed mesh, which is alone with any settings: "bind", or the names of its poses
    std::vector<std::string> poses;
    uint32_t instances = 0; ///< number of instances that are averaged; 0: alone
    double spread = 0; ///< rms difference of ambient occlusion between instances, or poses, and their mean
    std::optional<InstanceSpread> instance_spread; ///< of all instances, where there are several
    uint32_t levels = 0;
    uint32_t sampled_level = 0; ///< that samples lie on, if not on the proxy; finer ones are interpolated
    uint64_t samples = 0;
    uint64_t rays = 0;
    uint64_t interior_samples = 0; ///< interior samples: covered so closely that they hardly count
    double ray_seconds = 0;
    double fit_seconds = 0;
    double light_seconds = 0; ///< of the light of its instances' occluders
    MeshFitStatistics fit;
    ProxyUse proxy = ProxyUse::none; ///< use of the mesh's own proxy
};

struct BakeProgress
{
    double share = 0; ///< of all work, [0, 1]
    uint64_t rays = 0;
};

/// Progress callback, called now and then. Returns false to stop.
using BakeObserver = std::function<bool(const BakeProgress& progress)>;

/// Write the clusters part again, with visibility at the vertices of each mesh whose vertices have room for
/// it, with copies of meshes for instances that are unlike the others, and with the surroundings of its
/// instances. Writes nothing if `observe` returned false. The same bytes
/// for any number of threads.
///
/// import_part    instances, materials, images and the source's normals
/// clusters_part  of the same source
/// proxies        of the same source: part with the table of its proxies, for settings.proxies
/// neighbours     other sources in the same world that occlude, if settings.occluders is pack; opened one by
///                one
/// observe        may be empty
/// returns  nothing if `observe` returned false
/// errors: those of checkHierarchy, makeMeshProxies, rewriteVisibility, addMesh, openPart and
/// mesh::readSourceMesh;
/// meaning_reference if the parts are of different sources
Result<std::optional<std::vector<MeshStatistics>>>
writeVisibilityPart(const formats::PackView& import_part, const formats::PackView& clusters_part,
                    const formats::PackView& proxies, std::span<const PartPaths> neighbours,
                    const std::string& output_path, const BakeSettings& settings,
                    const BakeObserver& observe);

/// Return the statistics of all meshes as JSON text.
/// neighbours  number of other sources that occlude
std::string statisticsJson(const std::string& source, const BakeSettings& settings, size_t neighbours,
                           const std::vector<MeshStatistics>& meshes);

} // namespace hearth::visibility
