// C++ twin of the culling passes: computes them sequentially, with the code shared with the shaders.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/cull_statistics.h"
#include "formats/pack/pack_view.h"
#include "runtime/gpu/scene/scene_layout.h"
#include "tests/reference/culling/depth_pyramid.h"

#include <vector>

namespace hearth::test
{

using reference::isHidden;
using reference::makePyramid;
using reference::Pyramid;

/// Content of the passes' buffers.
struct Twin
{
    std::vector<shared::InstanceState> states;
    std::vector<shared::WorkResult> results;
    std::vector<uint32_t> totals;
    std::vector<shared::VisibleCluster> visible;
    std::vector<shared::BinDraw> bin_draws; ///< all bins, then all bins of the late phase
    std::vector<uint32_t> material_draws;
    uint32_t early_clusters = 0;
    shared::CullStatistics statistics{}; ///< as written by CullStatisticsPass
};

/// Compute the passes. Without kCullOcclusion in the view's flags the pyramids are not read.
/// last: pyramid that the early phase reads;  current: pyramid that it leaves for the late phase
/// resident_groups: one for each group, nonzero if resident; empty: all are
Twin makeTwin(const formats::PackView& pack, const gpu::SceneLayout& layout, const shared::FrameView& view,
              const Pyramid& last = {}, const Pyramid& current = {},
              std::span<const uint8_t> resident_groups = {});

/// Maximum of shared::groupPriority for each page.
std::vector<uint32_t> makeRequestTwin(const formats::PackView& pack, const gpu::SceneLayout& layout,
                                      const shared::FrameView& view);

/// Set poses like the frames do.
void applyPoses(std::span<const gpu::InstancePose> poses, gpu::SceneLayout& layout);

} // namespace hearth::test
