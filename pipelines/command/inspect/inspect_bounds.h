// hearth inspect --bounds: where the clusters of a pack's meshes are in a pose, by their records.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/command/inspect/posed_mesh.h"

#include <optional>
#include <string>

namespace hearth::command
{

/// JSON: for each mesh its clusters, each with its level, the box in the space that extractCut writes in, and which
/// triangles of the file that extractCut writes at error 0 are its own; null for clusters that are not in that file.
/// errors: usage where the clip does not exist; those of openPack.
Result<std::string> boundsJson(const std::string& path, const std::optional<ClipTime>& clip);

} // namespace hearth::command
