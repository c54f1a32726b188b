// Bakes visibility: reads an import part and its clusters part, and writes the clusters part with visibility
// at its vertices. See cook/visibility/README.md.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/fit/level_fit.h"
#include "cook/visibility/fit/refined_levels.h"
#include "cook/visibility/rays/rays.h"
#include "cook/visibility/scene/poses.h"
#include "formats/pack/pack_view.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace hearth::visibility
{

struct BakeSettings
{
    double samples_per_vertex = 8; ///< of the finest level
    RaySettings rays;              ///< rays_per_sample a power of two
    /// Rays hit only the mesh itself, in its own space, instead of all instances of the scene in the world.
    bool alone = false;
    LevelFitSettings fit;
    std::vector<ClipTimes> poses; ///< deformed meshes get the mean over these; empty: the bind pose
    bool refine_cones = false;    ///< fit cones to nine harmonics instead of four moments: refined_levels.h
    bool estimate_error = false;  ///< fill MeshStatistics::ao_error, which takes two more fits
};

/// Statistics of one baked mesh.
struct MeshStatistics
{
    uint32_t mesh = 0;
    std::string name;
    /// "rest"; for a deformed mesh, which is alone with any settings: "bind", or the names of its poses
    std::vector<std::string> poses;
    uint32_t instances = 0; ///< number of instances that are averaged; 0: alone
    uint32_t levels = 0;
    uint64_t samples = 0;
    uint64_t rays = 0;
    uint64_t interior_samples = 0; ///< interior samples: covered so closely that they hardly count
    double ray_seconds = 0;
    double fit_seconds = 0;
    ProxyStatistics proxy; ///< of the finest level
    uint32_t max_iterations_used = 0;
    double condition = 0;              ///< largest of all levels
    bool converged = true;             ///< on all levels
    uint64_t vertices = 0;             ///< of the proxies of all levels
    uint64_t clamped = 0;              ///< vertices whose fit was no valid visibility
    uint64_t unseen = 0;               ///< vertices of connected components without samples
    std::optional<RefineGain> refined; ///< if requested
    /// Rms error of ambient occlusion at the finest level's vertices, by the choice of samples and rays.
    std::optional<double> ao_error;
};

struct BakeProgress
{
    double share = 0; ///< of all work, [0, 1]
    uint64_t rays = 0;
};

/// Progress callback, called now and then. Returns false to stop.
using BakeObserver = std::function<bool(const BakeProgress& progress)>;

/// Write the clusters part again, with visibility at the vertices of each mesh whose vertices have room for
/// it. Writes nothing if `observe` returned false. The same bytes for any number of threads.
///
/// import_part    instances, materials, images and the source's normals
/// clusters_part  of the same source
/// observe        may be empty
/// returns  nothing if `observe` returned false
/// errors: those of checkHierarchy, rewriteVisibility, addMesh and mesh::readSourceMesh; meaning_reference if
/// the parts are of different sources
Result<std::optional<std::vector<MeshStatistics>>> writeVisibilityPart(const formats::PackView& import_part,
                                                                       const formats::PackView& clusters_part,
                                                                       const std::string& output_path,
                                                                       const BakeSettings& settings,
                                                                       const BakeObserver& observe);

/// Return the statistics of all meshes as JSON text.
std::string statisticsJson(const std::string& source, const BakeSettings& settings,
                           const std::vector<MeshStatistics>& meshes);

} // namespace hearth::visibility
