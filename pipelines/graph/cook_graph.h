// Builds the action graph of a cook: which cookers run over which sources, and the inputs of the link.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "pipelines/graph/action.h"

#include <optional>
#include <string>
#include <vector>

namespace hearth::graph
{

/// Options of hearth-visibility.
struct VisibilityOptions
{
    std::string quality = "default";
    std::string occluders = "scene";
    double distance = 0;            ///< metres; 0: no limit
    double power = 0;               ///< exponent of the falloff; needs a distance
    std::vector<std::string> poses; ///< poses of deformed meshes, "CLIP[@SECONDS,...]"; none: the bind pose
    bool refine = false;            ///< fit cones by nine spherical harmonics
};

/// Options of hearth-bricks. Unset options are chosen by the cooker.
struct BrickOptions
{
    std::optional<double> voxel_size;     ///< metres
    std::optional<uint64_t> memory_bytes; ///< on the GPU
    /// light bounces baked into the faces; none: faces start with their emission
    std::optional<uint32_t> bounces;
};

/// Command-line arguments of one source's cookers. They enter the cache keys by value, and an action stays
/// data that runs on any machine.
struct SourceSettings
{
    std::vector<std::string> import;             ///< as in "--set", "animation.error=0.001"
    std::vector<std::string> textures;           ///< as in "--max-size", "1024"
    std::vector<std::string> clusters;           ///< as in "--set", "clusters.influences=4"
    std::optional<VisibilityOptions> visibility; ///< none: no visibility is baked
};

/// Complete description of a cook, from which its graph is made.
struct CookSettings
{
    std::vector<std::string> sources;
    std::string output;
    /// [sources.size()], or empty: authored LODs of each source, as "N=FILE".
    std::vector<std::vector<std::string>> lods_of_source;
    /// [sources.size()], or empty: no arguments
    std::vector<SourceSettings> settings_of_source;
    std::optional<BrickOptions> bricks; ///< none: the pack has no grid of bricks
};

// Names of outputs beside the parts: statistics that cookers write about their input. They are small and
// always written, so that any cook can be reported on without running anything again.
inline constexpr const char* kImportStatistics = "import.json";
inline constexpr const char* kTexturesStatistics = "textures.json";
inline constexpr const char* kClustersStatistics = "clusters.json";
inline constexpr const char* kVisibilityStatistics = "visibility.json";
inline constexpr const char* kVisibilityPicture = "visibility.png";
inline constexpr const char* kBrickStatistics = "bricks.json";

/// Build the graph of a cook. errors: usage where the authored LODs are invalid.
Result<Graph> makeCookGraph(const CookSettings& settings);

} // namespace hearth::graph
