// The graph of a cook: which cookers run over which sources, and what the link takes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "pipelines/graph/action.h"

#include <optional>
#include <string>
#include <vector>

namespace hearth::graph
{

/// What hearth-visibility is told.
struct VisibilityOptions
{
    std::string quality = "default";
    std::string occluders = "scene";
    double distance = 0;            ///< metres; 0: no limit
    double power = 0;               ///< with a distance only
    std::vector<std::string> poses; ///< "CLIP[@SECONDS,...]": of deformed meshes; none: the bind pose
    bool refine = false;            ///< cones by nine harmonics
};

/// What hearth-bricks is told; else it decides itself.
struct BrickOptions
{
    std::optional<double> voxel_size;     ///< metres
    std::optional<uint64_t> memory_bytes; ///< of the GPU
    std::optional<uint32_t>
        bounces; ///< of the light that faces start with; none: they start with what they emit
};

/// What the cookers of one source are told. Words of their command lines: all of it is in their keys by value, and an action
/// stays data that runs on any machine.
struct SourceSettings
{
    std::vector<std::string> import;             ///< as "--set", "animation.error=0.001"
    std::vector<std::string> textures;           ///< as "--max-size", "1024"
    std::vector<std::string> clusters;           ///< as "--set", "clusters.influences=4"
    std::optional<VisibilityOptions> visibility; ///< none: vertices do not say what they see
};

/// What a cook makes of what: all that its graph is made from.
struct CookSettings
{
    std::vector<std::string> sources;
    std::string output;
    /// [sources.size()], or empty: the levels of detail of each source that were made by hand, as "N=FILE".
    std::vector<std::vector<std::string>> lods_of_source;
    std::vector<SourceSettings>
        settings_of_source;             ///< [sources.size()], or empty: their cookers are told nothing
    std::optional<BrickOptions> bricks; ///< none: the pack has no grid of bricks
};

// Names of outputs beside the parts: what cookers say of their input. They are small and always made, so that a report can be
// made of any cook without running anything again.
inline constexpr const char* kImportStatistics = "import.json";
inline constexpr const char* kTexturesStatistics = "textures.json";
inline constexpr const char* kClustersStatistics = "clusters.json";
inline constexpr const char* kVisibilityStatistics = "visibility.json";
inline constexpr const char* kVisibilityPicture = "visibility.png";
inline constexpr const char* kBrickStatistics = "bricks.json";

/// errors: usage where the levels of detail are not as they should be.
Result<Graph> makeCookGraph(const CookSettings& settings);

} // namespace hearth::graph
