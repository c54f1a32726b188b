// LOD cut of a mesh's hierarchy at one error for the whole mesh: the rule beside formats::GroupRecord.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <span>
#include <vector>

namespace hearth::pack
{

/// Return for each group of the view 1 if it and the rest of its set are resident: only then are its clusters
/// drawn, and only then does it replace the clusters that were made from it.
/// resident_pages  for each page of the view, not 0 if it is resident
std::vector<uint8_t> residentGroups(const formats::PackView& view, std::span<const uint8_t> resident_pages);

/// True if the cut at `error_object` (metres of object space, >= 0) draws a cluster. With `resident_groups`,
/// from residentGroups, the error of a group that is not resident counts as 0. If the resident pages are a
/// closed set with all roots (PageGraph), errors still never decrease towards the root, and the cut covers
/// the surface once. Without `resident_groups` all groups are resident.
bool inCut(const formats::PackView& view, const formats::ClusterRecord& cluster, float error_object,
           std::span<const uint8_t> resident_groups = {});

/// Return the clusters, ascending, that draw mesh `mesh` with an error of at most `error_object`, or as close
/// to it as the resident groups allow: 0 selects the source (and coarser clusters that are exact), infinity
/// the roots. Preconditions: the view's meaning has been checked; `mesh` is in its table.
std::vector<uint32_t> selectCut(const formats::PackView& view, uint32_t mesh, float error_object,
                                std::span<const uint8_t> resident_groups = {});

} // namespace hearth::pack
