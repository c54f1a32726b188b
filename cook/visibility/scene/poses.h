// Poses, other than the bind pose, in which deformed meshes are baked.
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

/// Times of a clip in a user's notation: "walk@0.2,0.7", or "walk" alone for kDefaultPosesPerClip times.
struct ClipTimes
{
    std::string clip;            ///< name, or index of a clip without a name
    std::vector<double> seconds; ///< from the clip's start; empty: evenly distributed
};

inline constexpr size_t kDefaultPosesPerClip = 4; ///< the middles of the clip's four quarters

/// Parse the notation of ClipTimes.
/// errors: nullopt if the text after the @ is no list of times, or one of them is negative
std::optional<ClipTimes> parseClipTimes(std::string_view text);

struct NamedPose
{
    std::string name; ///< "walk@0.2"
    formats::ScenePose pose;
};

/// Sample the poses of clips.
/// errors: meaning_reference if the scene has no such clip
Result<std::vector<NamedPose>> samplePoses(const formats::PackView& scene,
                                           const std::vector<ClipTimes>& clips);

/// Compute the vertex positions of a mesh's finest level in a pose, as its first instance has them: in the
/// world if the mesh has a skin, else in its own space. Empty if no node has the mesh.
std::vector<Float3> posedPositions(const formats::PackView& scene, const MeshPages& pages,
                                   const LevelArrays& finest, uint32_t mesh, const formats::ScenePose& pose);

} // namespace hearth::visibility
