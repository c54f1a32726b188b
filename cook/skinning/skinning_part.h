// Writes the skinning part: bounds of the meshes that skins and morph targets deform.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <functional>
#include <string>
#include <vector>

namespace hearth::skinning
{

/// Statistics of one mesh, for the report.
struct MeshStatistics
{
    uint32_t mesh = 0;
    std::string name;
    uint32_t joints = 0;
    uint32_t morph_targets = 0;
    uint32_t clusters = 0;
    uint32_t cones = 0;       ///< clusters with a cone that can cull
    uint32_t unbounded = 0;   ///< clusters whose joints can all be scaled to 0
    uint32_t most_joints = 0; ///< maximum number of joints of a cluster
    /// mean ratio of the surface area of a cluster's box to the surface area in the bind pose
    double box_growth = 0;
};

/// Write bounds of all deformed meshes: chunks DMSH, DCLU, DJNT and DGRP, empty if there are none. The result
/// does not depend on the number of threads.
///
/// import_part    nodes, skins and animations
/// clusters_part  of the same source
/// errors: container_kind; errors of checkAnimationTables and of readClusters; meaning_reference where the
/// parts are of different sources; cannot_write.
Result<std::vector<MeshStatistics>> writeSkinningPart(const formats::PackView& import_part,
                                                      const formats::PackView& clusters_part,
                                                      const std::string& output_path);

/// Return the statistics of all meshes as JSON text.
std::string statisticsJson(const std::string& source, const std::vector<MeshStatistics>& meshes);

} // namespace hearth::skinning
