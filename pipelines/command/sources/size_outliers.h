// Finds sources whose scale differs from the rest of their cook: exported in centimetres, scanned in
// millimetres.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <string>
#include <vector>

namespace hearth::command
{

struct SizeOutlier
{
    size_t source = 0;
    std::string warning; ///< message line, W1410
};

/// Return the sources whose largest side is at least 20 times that of the median source, or at most a 20th of
/// it, in their order. Sources that draw nothing do not count; fewer than three sources have no outliers.
/// pack     its assets are the sources; a pack that cannot be read has no outliers
/// sources  names of the sources, for messages
std::vector<SizeOutlier> findSizeOutliers(const std::string& pack, const std::vector<std::string>& sources);

} // namespace hearth::command
