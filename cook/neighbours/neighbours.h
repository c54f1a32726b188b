// Finds for each source of a pack the sources that can occlude it, from their bounding boxes. See README.md.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"
#include "formats/base/result.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hearth::neighbours
{

/// Indices of the neighbours of each source, ascending.
using Neighbours = std::vector<std::vector<uint32_t>>;

/// Upper bound of the ambient occlusion by one source that is no neighbour, at any point of the other source.
/// It is as much as the noise of rays at quality default, .004 rms.
inline constexpr double kMaxOcclusionLeftOut = 1.0 / 256;

/// Return the neighbours of each source: all but those that occlude less than kMaxOcclusionLeftOut from
/// everywhere in its box. Sources that were never placed have none (formats/scene/asset_placement.h).
/// boxes  of the sources, world space; an empty box has no neighbours and is none
Neighbours findNeighbours(std::span<const Box3> boxes);

/// Return a line for each source: the indices of its neighbours, with spaces between them.
std::string neighboursText(const Neighbours& neighbours);

/// Read the box of a source from the statistics of its import.
/// errors: json_syntax, which names `file`, also where there is no box
Result<Box3> parseBox(std::string_view import_statistics, const std::string& file);

} // namespace hearth::neighbours
