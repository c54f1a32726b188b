// From an import part and its clusters part to the clusters part with what its vertices see. See cook/visibility/README.md.
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
    /// Rays meet the mesh alone, in its own space, instead of all instances of the scene in the world.
    bool alone = false;
    LevelFitSettings fit;
    std::vector<ClipTimes> poses; ///< deformed meshes have the mean over these; none: the bind pose
    bool refine_cones = false;    ///< nine harmonics instead of four moments: refined_levels.h
    bool estimate_error = false;  ///< fill MeshStatistics::ao_error, for two more fits
};

/// What became of one mesh.
struct MeshStatistics
{
    uint32_t mesh = 0;
    std::string name;
    /// "rest"; of a deformed mesh, which is alone whatever the settings: "bind", or the names of its poses
    std::vector<std::string> poses;
    uint32_t instances = 0; ///< whose surroundings are averaged; 0: alone
    uint32_t levels = 0;
    uint64_t samples = 0;
    uint64_t rays = 0;
    uint64_t buried = 0; ///< samples that something covers so closely that they hardly count
    double ray_seconds = 0;
    double fit_seconds = 0;
    ProxyStatistics proxy; ///< of the finest level
    uint32_t most_iterations = 0;
    double condition = 0;              ///< the largest of all levels
    bool converged = true;             ///< on all levels
    uint64_t vertices = 0;             ///< of the proxies of all levels
    uint64_t clamped = 0;              ///< of them, whose fit was not the visibility of anything
    uint64_t unseen = 0;               ///< of them, on pieces without a sample
    std::optional<RefineGain> refined; ///< where asked for
    std::optional<double>
        ao_error; ///< rms of ambient occlusion at the finest level's vertices, by the choice of samples and rays
};

struct BakeProgress
{
    double share = 0; ///< of all work, [0, 1]
    uint64_t rays = 0;
};

/// Told now and then how far it is; returns whether to go on.
using BakeObserver = std::function<bool(const BakeProgress& progress)>;

/// Write the clusters part again, its vertices with what they see: of each mesh whose vertices have room for it. Nothing
/// is written where `observe` said to stop. The same bytes for any number of threads.
///
/// import_part    instances, materials and images
/// clusters_part  of the same source
/// observe        may be empty
/// returns  nothing where `observe` said to stop
/// errors: those of checkHierarchy, rewriteVisibility and addMesh; meaning_reference where the parts are of different
/// sources
Result<std::optional<std::vector<MeshStatistics>>> writeVisibilityPart(const formats::PackView& import_part,
                                                                       const formats::PackView& clusters_part,
                                                                       const std::string& output_path,
                                                                       const BakeSettings& settings,
                                                                       const BakeObserver& observe);

/// The statistics of all meshes as JSON text.
std::string statisticsJson(const std::string& source, const BakeSettings& settings,
                           const std::vector<MeshStatistics>& meshes);

} // namespace hearth::visibility
