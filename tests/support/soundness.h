// Checks all guarantees of a hierarchy in one call.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/hierarchy.h"

#include <span>
#include <string>

namespace hearth::cuts
{

/// Empty if the hierarchy is valid and no cut of several kinds has a crack, otherwise the first problem.
/// Cuts: at every level's error, random closed cuts, and cuts for eyes in and around the mesh.
std::string unsoundness(const mesh::SourceMesh& mesh, const clusters::Hierarchy& hierarchy,
                        std::span<const mesh::SourceMesh> authored = {});

} // namespace hearth::cuts
