// The cut of a mesh's hierarchy at one error for the whole mesh: the rule beside formats::GroupRecord.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack_view.h"

#include <vector>

namespace hearth::pack
{

/// Whether the cut at `error_object` (metres of object space, >= 0) draws a cluster.
bool inCut(const formats::PackView& view, const formats::ClusterRecord& cluster, float error_object);

/// The clusters, ascending, that draw mesh `mesh` with an error of at most `error_object` at the coarsest: 0 gives the
/// source (and what is exact about it), infinity the roots. The view's meaning has been checked; `mesh` is in its table.
std::vector<uint32_t> selectCut(const formats::PackView& view, uint32_t mesh, float error_object);

} // namespace hearth::pack
