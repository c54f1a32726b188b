// hearth inspect --bounds: lists the bounding boxes of all clusters in a pose, by their records.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/command/extract/posed_mesh.h"

#include <optional>
#include <string>

namespace hearth::command
{

/// Return JSON: for each mesh its clusters, each with its level, its box in the space of extractCut, and its
/// range of triangles in the file that extractCut writes at error 0; null for clusters that are not in that
/// file.
/// errors: usage if the clip does not exist; those of openPack.
Result<std::string> boundsJson(const std::string& path, const std::optional<ClipTime>& clip);

} // namespace hearth::command
