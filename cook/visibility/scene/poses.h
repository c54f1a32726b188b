// Poses that deformed meshes are baked in, other than the bind pose.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/scene/level_meshes.h"
#include "formats/scene/animation.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hearth::visibility
{

/// Times of a clip, as a user names them: "walk@0.2,0.7", or "walk" alone, which is its kPosesOfClip times.
struct ClipTimes
{
    std::string clip;            ///< its name, or its index where it has none
    std::vector<double> seconds; ///< from its start; empty: evenly over it
};

inline constexpr size_t kPosesOfClip = 4; ///< the middles of its four quarters

/// errors: none but nullopt where what follows the @ is no list of times, none of them negative
std::optional<ClipTimes> parseClipTimes(std::string_view text);

struct NamedPose
{
    std::string name; ///< "walk@0.2"
    formats::ScenePose pose;
};

/// errors: meaning_reference where the scene has no such clip
Result<std::vector<NamedPose>> posesOf(const formats::PackView& scene, const std::vector<ClipTimes>& clips);

/// Where the vertices of a mesh's finest level are in a pose: as its first instance has them, in the world if the mesh has a
/// skin, else in its own space. Empty where no node has the mesh.
std::vector<Float3> posedPositions(const formats::PackView& scene, const MeshPages& pages,
                                   const LevelArrays& finest, uint32_t mesh, const formats::ScenePose& pose);

} // namespace hearth::visibility
