// Checks all guarantees of a hierarchy in one call.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/hierarchy.h"

#include <span>
#include <string>

namespace hearth::cuts
{

/// Empty if the hierarchy is valid, no cut of several kinds has a crack, and no level leaves the box of the
/// source by more than a tenth of its diagonal; otherwise the first problem. The last is not promised for
/// authored LODs, which may be larger.
/// Cuts: at every level's error, random closed cuts, and cuts for eyes in and around the mesh.
std::string unsoundness(const mesh::SourceMesh& mesh, const clusters::Hierarchy& hierarchy,
                        std::span<const mesh::SourceMesh> authored = {});

} // namespace hearth::cuts
