// Warnings about sources of another scale than the rest of their cook: exported in centimetres, scanned in millimetres.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <string>
#include <vector>

namespace hearth::command
{

struct SizeOutlier
{
    size_t source = 0;
    std::string warning; ///< line, W1410
};

/// Returns the sources whose largest side is 20 times that of the median source or more, or a 20th of it or less, in their
/// order. Sources that draw nothing do not count; of fewer than three none is returned.
/// pack     its assets are the sources; one that cannot be read has no outliers
/// sources  as messages call them
std::vector<SizeOutlier> findSizeOutliers(const std::string& pack, const std::vector<std::string>& sources);

} // namespace hearth::command
