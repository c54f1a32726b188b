// Decodes the clusters that rays meet: those of materials without holes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/voxels/static_scene.h"
#include "formats/base/result.h"

#include <functional>

namespace hearth::bricks
{

using ClusterVisitor =
    std::function<void(const StaticInstance&, const formats::ClusterGeometry&, const SurfaceMaterial&)>;

/// Call `visit` for each cluster whose material has no holes, in order.
/// errors: errors of decoding pages
Status visitOpaqueClusters(const StaticScene& scene, std::span<const InstancedCluster> placed,
                           const ClusterVisitor& visit);

} // namespace hearth::bricks
