// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/cut_errors.h"

#include "tests/support/cuts.h"

#include <algorithm>

namespace hearth::cuts
{

double storedPositionError(const clusters::Hierarchy& hierarchy, std::span<const uint8_t> replaced)
{
    double error = 0;
    for (const uint32_t c : clusters::findCutClusters(hierarchy, replaced))
        if (const uint32_t refined = hierarchy.clusters[c].refined_group; refined != kInvalidIndex)
            error = std::max(error, double{hierarchy.groups[refined].position_error});
    return error;
}

std::vector<CutError> certifyLevels(const mesh::SourceMesh& source, const clusters::Hierarchy& hierarchy,
                                    const clusters::DecodedHierarchy& decoded, const DistanceSearch& search)
{
    std::vector<CutError> errors;
    for (uint32_t level = 1; level < hierarchy.levels.size(); ++level)
    {
        const auto replaced = cutAtError(hierarchy, double{hierarchy.levels[level].max_error});
        const auto triangles = trianglesOfCut(hierarchy, decoded, replaced);
        errors.push_back(
            {level, triangles.size() / 3, storedPositionError(hierarchy, replaced),
             certifyDistance({decoded.positions, triangles}, {source.positions, source.indices}, search)});
    }
    return errors;
}

} // namespace hearth::cuts
